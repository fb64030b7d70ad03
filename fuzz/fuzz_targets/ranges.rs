#![no_main]
libfuzzer_sys::fuzz_target!(|asked: (u8, u8, [u8; 2], [f64; 2])| slideway_fuzz::ranges(asked));
