//! A module as a library, which a host such as 3D Slicer loads and runs in its own process.
//!
//! The host asks for the names that [`shared_object!`](crate::shared_object) exports. Standard error stays
//! silent, signals and the process are left alone, and what is wrong becomes the host's
//! [`ProcessInformation::message`].

#![allow(unsafe_code, reason = "hosts pass raw pointers")]
#![warn(clippy::undocumented_unsafe_blocks)]

use crate::module::Module;
use crate::progress::{Listener, Output};
use crate::run;
use std::ffi::{CStr, OsStr, OsString, c_char, c_int, c_void};
use std::ops::ControlFlow;
use std::os::unix::ffi::OsStrExt;
use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::ptr::NonNull;
use std::rc::Rc;
use std::sync::Once;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Instant;

/// What a module returns, as a program and as a library, after a mistake of its own.
const PANIC: c_int = 101;

/// What a host and its module tell each other: `ModuleProcessInformation` of the
/// [Slicer Execution Model](https://github.com/Slicer/SlicerExecutionModel), in
/// `ModuleDescriptionParser/ModuleProcessInformation.h`.
#[repr(C)]
#[derive(Debug)]
pub struct ProcessInformation {
    /// Not 0 if the module should stop.
    pub abort: u8,
    /// The finished part, from 0 to 1.
    pub progress: f32,
    /// That of a stage; heatpath leaves it alone.
    pub stage_progress: f32,
    /// What there is to say, ended by a 0.
    pub message: [u8; 1024],
    /// Called when something has changed, if there are data.
    pub callback: Option<unsafe extern "C" fn(*mut c_void)>,
    /// What it is called with.
    pub client_data: *mut c_void,
    /// Seconds since the module began.
    pub elapsed_time: f64,
}

/// A host that has passed the address of its [`ProcessInformation`].
struct Host {
    information: NonNull<ProcessInformation>,
    start: Instant,
}

impl Host {
    /// Writes and reads without references, as other threads of the host do the same meanwhile.
    fn update(&self, finished: Option<f64>) -> ControlFlow<()> {
        let information = self.information.as_ptr();
        // SAFETY: the caller of `entry_point` lends the information for the whole call, and the
        // callback may be called with the data beside it.
        let abort = unsafe {
            if let Some(finished) = finished {
                (&raw mut (*information).progress).write_volatile(finished as f32);
            }
            let elapsed = self.start.elapsed().as_secs_f64();
            (&raw mut (*information).elapsed_time).write_volatile(elapsed);
            let data = (*information).client_data;
            if let Some(callback) = (*information).callback.filter(|_| !data.is_null()) {
                callback(data);
            }
            AtomicU8::from_ptr(&raw mut (*information).abort).load(Ordering::Relaxed)
        };
        if abort == 0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }

    fn say(&self, text: &str) {
        let mut message = [0; 1024];
        // The end of what fits, in no character's middle.
        let length = (0..message.len()).rfind(|&end| text.is_char_boundary(end)).unwrap_or(0);
        message[..length].copy_from_slice(&text.as_bytes()[..length]);
        // SAFETY: as in `update`.
        unsafe { (&raw mut (*self.information.as_ptr()).message).write_volatile(message) };
        // There is nothing left to stop.
        let _ = self.update(None);
    }
}

impl Listener for Host {
    fn begin(&self) {
        let _ = self.update(Some(0.0));
    }

    fn tell(&self, finished: f64) -> ControlFlow<()> {
        self.update(Some(finished))
    }

    fn end(&self) {
        let _ = self.update(Some(1.0));
    }
}

/// What `ModuleEntryPoint` does: runs the module, and returns the exit code of its program.
///
/// # Safety
/// `arguments` are `count` pointers to texts that end with 0. If `--processinformationaddress` is one of
/// them, the next is the address of a [`ProcessInformation`] in hexadecimal digits, which stays where it is
/// until this returns.
pub unsafe fn entry_point(
    module: &'static Module,
    count: c_int,
    arguments: *const *const c_char,
) -> c_int {
    be_a_guest();
    // SAFETY: promised by the caller.
    let words = unsafe { words(count, arguments) };
    let host =
        address(&words).map(|information| Rc::new(Host { information, start: Instant::now() }));
    let listener: Rc<dyn Listener> = match &host {
        Some(host) => Rc::clone(host) as _,
        None => Output::listener(module.name),
    };
    let (code, message) = guarded(|| match run(module, words, &listener) {
        Ok(()) => (0, None),
        Err(failure) => (failure.code().into(), Some(failure.to_string())),
    });
    // The host's information is its own again.
    heatpath_cli::watch(|_| ControlFlow::Continue(()));
    if let (Some(host), Some(message)) = (host, message) {
        host.say(&message);
    }
    code
}

/// # Safety
/// As for [`entry_point`].
unsafe fn words(count: c_int, arguments: *const *const c_char) -> Vec<OsString> {
    let word = |i| {
        // SAFETY: promised by the caller.
        let text = unsafe { CStr::from_ptr(*arguments.add(i)) };
        OsStr::from_bytes(text.to_bytes()).to_owned()
    };
    (0..usize::try_from(count).unwrap_or(0)).map(word).collect()
}

/// Where the host's information is, as `printf` writes it with `%p`.
fn address(words: &[OsString]) -> Option<NonNull<ProcessInformation>> {
    let option = words.iter().position(|word| word == "--processinformationaddress")?;
    let text = words.get(option + 1)?.to_str()?;
    let number = usize::from_str_radix(text.trim_start_matches("0x"), 16).ok()?;
    let pointer =
        NonNull::new(std::ptr::with_exposed_provenance_mut::<ProcessInformation>(number))?;
    pointer.is_aligned().then_some(pointer)
}

/// From now on panics print nothing, and signals are the host's. The hook is that of this library's own
/// copy of Rust's standard library.
fn be_a_guest() {
    static GUEST: Once = Once::new();
    GUEST.call_once(|| {
        panic::set_hook(Box::new(|_| ()));
        heatpath_cli::be_a_guest();
    });
}

/// Lets no panic out.
fn guarded(work: impl FnOnce() -> (c_int, Option<String>)) -> (c_int, Option<String>) {
    catch_unwind(AssertUnwindSafe(work))
        .unwrap_or_else(|_| (PANIC, Some("a mistake inside heatpath; please report it".to_owned())))
}

/// Exports what hosts ask a module's library for.
///
/// | name | what |
/// | --- | --- |
/// | `XMLModuleDescription` | the description, `char[]` that ends with 0 |
/// | `GetXMLModuleDescription` | the same from a function |
/// | `ModuleEntryPoint` | [`entry_point`](crate::library::entry_point) |
#[macro_export]
macro_rules! shared_object {
    ($module:expr, $description:expr) => {
        /// The description of the module.
        #[unsafe(no_mangle)]
        pub static XMLModuleDescription: [u8; $description.len()] = *$description;

        /// The description of the module.
        #[unsafe(no_mangle)]
        pub extern "C" fn GetXMLModuleDescription() -> *const std::ffi::c_char {
            XMLModuleDescription.as_ptr().cast()
        }

        /// Runs the module.
        ///
        /// # Safety
        /// As for [`entry_point`](heatpath_slicer::library::entry_point).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn ModuleEntryPoint(
            count: std::ffi::c_int,
            arguments: *const *const std::ffi::c_char,
        ) -> std::ffi::c_int {
            // SAFETY: promised by the caller.
            unsafe { $crate::library::entry_point(&$module, count, arguments) }
        }
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::mem::offset_of;

    /// As a C++ compiler lays it out on 64 bits.
    #[test]
    #[cfg(target_pointer_width = "64")]
    fn the_information_has_its_layout() {
        assert_eq!(offset_of!(ProcessInformation, progress), 4);
        assert_eq!(offset_of!(ProcessInformation, message), 12);
        assert_eq!(offset_of!(ProcessInformation, callback), 1040);
        assert_eq!(offset_of!(ProcessInformation, elapsed_time), 1056);
        assert_eq!(size_of::<ProcessInformation>(), 1064);
    }

    #[test]
    fn panics_become_a_code() {
        let (code, message) = guarded(|| panic!("for this test"));
        assert_eq!(code, PANIC);
        assert!(message.is_some());
    }

    #[test]
    fn addresses_are_those_of_printf() {
        let words = |text: &str| ["m", "--processinformationaddress", text].map(OsString::from);
        let found = |text| address(&words(text)).map(|pointer| pointer.addr().get());
        assert_eq!(found("0x7ffe12345678"), Some(0x7ffe_1234_5678));
        assert_eq!(found("7ffe12345678"), Some(0x7ffe_1234_5678));
        for none in ["0", "(nil)", "0x7", "", "much"] {
            assert_eq!(found(none), None, "{none}");
        }
        assert_eq!(address(&words("8")[..2]), None);
    }
}
