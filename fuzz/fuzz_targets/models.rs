#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    periodyn_fuzz::models::run(data);
});
