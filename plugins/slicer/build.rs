//! Writes the description of each module into a file: libraries have it as data.

#![allow(dead_code, unreachable_pub, reason = "the modules are those of the crate")]

#[path = "src/module.rs"]
mod module;
#[path = "src/modules/mod.rs"]
mod modules;
#[path = "src/xml.rs"]
mod xml;

use module::Module;
use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=src");
    if env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        // dlclose must not unmap code that a thread about to end may still run.
        println!("cargo::rustc-link-arg=-Wl,-z,nodelete");
        // Four programs and four libraries, each with the same 300 MB about lines.
        println!("cargo::rustc-link-arg=-Wl,--strip-debug");
    }
    let folder = env::var_os("OUT_DIR").unwrap_or_default();
    for module in modules::ALL {
        let text = xml::description(module) + "\0";
        fs::write(Path::new(&folder).join(module.name).with_extension("xml"), text)?;
    }
    Ok(())
}
