#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| hlr_kernel_fuzz::brepfile::run(data));
