#![no_main]
libfuzzer_sys::fuzz_target!(|text: &str| slideway_fuzz::expression(text));
