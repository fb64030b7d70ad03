N = 64
NUMBERS := $(shell seq -w $(N))
SHARDS := $(NUMBERS:%=results/shard-%-of-$(N).parquet)
export RAYON_NUM_THREADS = 1

drawer.parquet: $(SHARDS)
	slideway sweep --merge results --output $@ --force

results/shard-%-of-$(N).parquet: drawer.toml
	rm -f $@
	slideway sweep drawer.toml --vary mu=0..0.8:8001 --vary a=0..0.4:401 --shard $*/$(N) --output results
