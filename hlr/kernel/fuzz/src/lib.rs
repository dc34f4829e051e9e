//! What the fuzz targets do with their bytes: read a case, call the kernel, hold the answer against what must be true.
//!
//! Plain functions without libFuzzer, so that `cargo test` replays the corpus with them on any toolchain.

pub mod brep;
pub mod bytes;
pub mod clash;
pub mod linework;
pub mod meshfile;
pub mod oracle;
pub mod scene;
pub mod topology;
pub mod visibility;
