//! The library is loaded at run time, as plugins of a viewer are.

#![expect(unsafe_code, reason = "calls functions that are found by name")]

use heatpath_ffi_tests::shared_library;
use libloading::{Library, Symbol};
use std::ffi::{CStr, c_char};

#[test]
fn the_library_can_be_loaded_used_and_closed() {
    for _ in 0..2 {
        // SAFETY: loading runs no code of heatpath.
        let library = unsafe { Library::new(shared_library()) }.unwrap();
        // SAFETY: these are the functions of the header.
        let version = unsafe {
            let abi: Symbol<unsafe extern "C" fn() -> u32> = library.get("hp_abi_version").unwrap();
            assert_eq!(abi(), heatpath::HP_ABI_VERSION);
            let version: Symbol<unsafe extern "C" fn() -> *const c_char> =
                library.get("hp_version_string").unwrap();
            CStr::from_ptr(version())
        };
        assert_eq!(version.to_str().unwrap(), env!("CARGO_PKG_VERSION"));
        library.close().unwrap();
    }
}
