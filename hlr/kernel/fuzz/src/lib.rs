//! The fuzz targets: each makes a case from bytes, calls the kernel, and checks the result.
//!
//! Plain functions without libFuzzer, so that `cargo test` replays the corpus with them on any toolchain.

pub mod brep;
pub mod brepfile;
pub mod bytes;
pub mod clash;
pub mod linework;
pub mod meshfile;
pub mod oracle;
pub mod scene;
pub mod topology;
pub mod visibility;
