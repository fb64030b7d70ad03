#![no_main]
libfuzzer_sys::fuzz_target!(|asked: (u8, bool, &str)| slideway_fuzz::limits(asked));
