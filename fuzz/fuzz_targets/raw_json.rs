#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| slideway_fuzz::raw_json(bytes));
