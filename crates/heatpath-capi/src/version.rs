//! Which library this is.

use std::ffi::c_char;

/// The version of the binary interface that this header describes.
///
/// It is the number in the name of the shared library, libheatpath.so.0. It stays 0 as long as the
/// version of heatpath begins with 0, because until then each minor version may change anything:
/// compare hp_version_string() as well. From heatpath 1.0 on it changes when, and only when,
/// programs must be recompiled.
pub const HP_ABI_VERSION: u32 = 0;

/// The HP_ABI_VERSION of the library that is loaded. A program that loads the library at run time
/// compares it with the one of its header before any other call.
#[unsafe(no_mangle)]
pub extern "C" fn hp_abi_version() -> u32 {
    HP_ABI_VERSION
}

/// The version of the library that is loaded, such as "0.1.0". The text is never freed.
#[unsafe(no_mangle)]
pub extern "C" fn hp_version_string() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}
