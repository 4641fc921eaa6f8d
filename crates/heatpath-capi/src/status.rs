//! What functions return, and the message that goes with it.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What a function returns: HP_OK or the reason why it failed. The numbers never change their
/// meaning; later versions may add some.
pub type hp_status = i32;

/// Done.
pub const HP_OK: i32 = 0;
/// A pointer is NULL or misaligned, the size of a struct is wrong, or an option makes no sense.
pub const HP_INVALID_ARGUMENT: i32 = 1;
/// The description of a buffer or list is wrong: its type, sizes, strides or spacing.
pub const HP_INVALID_BUFFER: i32 = 2;
/// A pixel or value is infinite or not a number, or a given medium is not positive somewhere.
pub const HP_INVALID_IMAGE: i32 = 3;
/// A source or an end is missing, outside the image, inside a wall, not on the mesh, or not a number.
pub const HP_INVALID_POINT: i32 = 4;
/// The time step is larger than the medium allows; the message says how large it may be.
pub const HP_UNSTABLE_STEP: i32 = 5;
/// The progress callback asked to stop.
pub const HP_CANCELLED: i32 = 6;
/// There is not enough memory for a problem of this size, or HP_SOLVER_IMPLICIT needs more than
/// hp_options.memory allows; the message says how much.
pub const HP_OUT_OF_MEMORY: i32 = 7;
/// The operating system refused to start the threads.
pub const HP_NO_THREADS: i32 = 8;
/// This version of the library cannot do that.
pub const HP_UNSUPPORTED: i32 = 9;
/// A mistake inside heatpath. The library stays usable; please report it with the message.
pub const HP_PANIC: i32 = 10;
/// The medium is slower in places than the range of numbers allows.
pub const HP_RANGE: i32 = 11;
/// Points and faces are no mesh: there is no face, a face uses a vertex that does not exist, or a
/// coordinate is infinite or not a number; or faces lie in each other, and HP_MESH_EXACT does not end.
pub const HP_INVALID_MESH: i32 = 12;
/// There is nothing to find: the image shows no structure, or no heat from one end reaches the other.
pub const HP_NO_ANSWER: i32 = 13;

/// Why a call failed.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) status: hp_status,
    pub(crate) message: String,
}

impl Failure {
    pub(crate) fn new(status: hp_status, message: impl Into<String>) -> Self {
        Self { status, message: message.into() }
    }

    pub(crate) fn argument(message: impl Into<String>) -> Self {
        Self::new(HP_INVALID_ARGUMENT, message)
    }

    /// The same failure, its message beginning with the name of what it is about.
    pub(crate) fn of(self, name: &str) -> Self {
        Self { message: format!("{name}: {}", self.message), ..self }
    }
}

thread_local! {
    /// The message of the last failure on this thread.
    static MESSAGE: RefCell<CString> = RefCell::default();
}

/// Runs the body of an exported function: turns failures and panics into a status and a message.
pub(crate) fn guard(body: impl FnOnce() -> Result<(), Failure>) -> hp_status {
    let result = catch_unwind(AssertUnwindSafe(body));
    let Err(failure) = result.unwrap_or_else(|panic| Err(from_panic(&*panic))) else {
        return HP_OK;
    };
    let line = failure.message.replace(['\0', '\n'], " ");
    // While the thread ends, its storage is gone already: then there is a status only.
    let _ = MESSAGE.try_with(|message| message.replace(CString::new(line).unwrap_or_default()));
    failure.status
}

fn from_panic(panic: &(dyn Any + Send)) -> Failure {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no details");
    Failure::new(HP_PANIC, format!("a mistake inside heatpath, please report it: {text}"))
}

/// The message of the last call that failed on this thread: one line, in English, UTF-8. An empty
/// text if none has failed yet; calls that succeed leave it as it is.
///
/// The text belongs to the library and stays valid until the next call that fails on the same
/// thread, or until the thread ends.
#[unsafe(no_mangle)]
pub extern "C" fn hp_last_error_message() -> *const c_char {
    MESSAGE.try_with(|message| message.borrow().as_ptr()).unwrap_or(c"".as_ptr())
}

/// The name of a status, such as "HP_INVALID_POINT"; "unknown status" for any other number. The
/// text is never freed.
#[unsafe(no_mangle)]
pub extern "C" fn hp_status_name(status: hp_status) -> *const c_char {
    name_of(status).as_ptr()
}

fn name_of(status: hp_status) -> &'static CStr {
    match status {
        HP_OK => c"HP_OK",
        HP_INVALID_ARGUMENT => c"HP_INVALID_ARGUMENT",
        HP_INVALID_BUFFER => c"HP_INVALID_BUFFER",
        HP_INVALID_IMAGE => c"HP_INVALID_IMAGE",
        HP_INVALID_POINT => c"HP_INVALID_POINT",
        HP_UNSTABLE_STEP => c"HP_UNSTABLE_STEP",
        HP_CANCELLED => c"HP_CANCELLED",
        HP_OUT_OF_MEMORY => c"HP_OUT_OF_MEMORY",
        HP_NO_THREADS => c"HP_NO_THREADS",
        HP_UNSUPPORTED => c"HP_UNSUPPORTED",
        HP_PANIC => c"HP_PANIC",
        HP_RANGE => c"HP_RANGE",
        HP_INVALID_MESH => c"HP_INVALID_MESH",
        HP_NO_ANSWER => c"HP_NO_ANSWER",
        _ => c"unknown status",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message() -> String {
        MESSAGE.with(|message| message.borrow().to_str().unwrap().to_owned())
    }

    #[test]
    fn a_panic_becomes_a_status() {
        assert_eq!(guard(|| panic!("cell {} of {}", 7, 5)), HP_PANIC);
        assert_eq!(message(), "a mistake inside heatpath, please report it: cell 7 of 5");
        assert_eq!(guard(|| std::panic::panic_any(7_u8)), HP_PANIC);
        assert!(message().ends_with("no details"));
    }

    #[test]
    fn a_panic_inside_the_engine_becomes_a_status() {
        use heatpath_core::Exec;
        use heatpath_core::grid::heat::{Explicit, HeatOptions};
        use heatpath_core::grid::{Shape, Sources, medium};

        let medium = medium::uniform(Shape::new([64, 64]).unwrap());
        let sources = Sources::new(&[[5.0, 5.0]], medium.mask()).unwrap();
        let explicit = Explicit::new(&medium, HeatOptions::default()).unwrap();
        let exec = Exec::new(3).unwrap();
        let injected = exec.with_watch(|finished| panic!("injected at {finished:.0}"));
        assert_eq!(guard(|| Ok(explicit.flow(&sources, &injected).map(drop)?)), HP_PANIC);
        assert!(message().contains("injected at"), "{}", message());
        let single = Exec::single_threaded();
        assert_eq!(guard(|| Ok(explicit.flow(&sources, &single).map(drop)?)), HP_OK);
    }

    #[test]
    fn a_message_is_one_line_and_survives_success() {
        assert_eq!(guard(|| Err(Failure::argument("a\nb\0c"))), HP_INVALID_ARGUMENT);
        assert_eq!(guard(|| Ok(())), HP_OK);
        assert_eq!(message(), "a b c");
        let elsewhere = std::thread::spawn(message).join().unwrap();
        assert_eq!(elsewhere, "", "each thread has its own");
    }

    #[test]
    fn numbers_are_for_ever() {
        let names: Vec<_> = (0..15).map(|status| name_of(status).to_str().unwrap()).collect();
        assert_eq!(
            names,
            [
                "HP_OK",
                "HP_INVALID_ARGUMENT",
                "HP_INVALID_BUFFER",
                "HP_INVALID_IMAGE",
                "HP_INVALID_POINT",
                "HP_UNSTABLE_STEP",
                "HP_CANCELLED",
                "HP_OUT_OF_MEMORY",
                "HP_NO_THREADS",
                "HP_UNSUPPORTED",
                "HP_PANIC",
                "HP_RANGE",
                "HP_INVALID_MESH",
                "HP_NO_ANSWER",
                "unknown status",
            ]
        );
    }
}
