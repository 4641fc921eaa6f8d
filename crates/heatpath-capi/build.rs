//! Names the shared library after its ABI and keeps it loaded.

/// The ABI's major version, as in `src/version.rs`.
const ABI_VERSION: &str = "0";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        // Programs ask the loader for this name, so two ABIs can be installed side by side.
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libheatpath.so.{ABI_VERSION}");
        // dlclose must not unmap code that a thread about to end may still run.
        println!("cargo::rustc-cdylib-link-arg=-Wl,-z,nodelete");
    }
}
