//! heatpath as command line modules of 3D Slicer, and of everything else that runs such modules.
//!
//! A [`Module`] is a table of parameters. It is told to Slicer as XML, which makes a panel of it, and
//! what Slicer then passes to the program becomes a command line of `heatpath`: the module *is* the
//! command, in the same process, so that results are equal and nothing has to be found on the
//! disk. [`modules`] has the tables; each program in `bin` runs one of them.
//!
//! The rules of the XML are those that Slicer, CTK, nipype and Girder agree on: the names of
//! options are letters and digits, children have one order, and there are no scalar outputs.
//!
//! Each module is a program in `bin`, and a library in `libraries` for hosts that load it
//! ([`shared_object!`]).

mod arguments;
pub mod library;
mod logo;
mod module;
pub mod modules;
mod progress;
mod xml;

pub use arguments::{Request, command_line};
pub use module::{Channel, FileKind, Group, Kind, Module, Parameter};
pub use xml::description;

use heatpath_cli::Failure;
use heatpath_io::write_atomically;
use progress::{Listener, Output};
use std::cell::Cell;
use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;
use std::rc::Rc;

/// The program of a module.
#[must_use]
pub fn main(module: &Module) -> ExitCode {
    match run(module, std::env::args_os(), &Output::listener(module.name)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // If standard error is closed there is nobody to tell.
            drop(writeln!(io::stderr(), "{}: error: {failure}", module.name));
            failure.code().into()
        }
    }
}

fn run(
    module: &Module,
    words: impl IntoIterator<Item = OsString>,
    listener: &Rc<dyn Listener>,
) -> Result<(), Failure> {
    match command_line(module, words)? {
        Request::Help(text) => print(&text),
        Request::Xml => print(&description(module)),
        Request::Logo => print(&logo::logo()),
        Request::Run { words, return_parameters } => {
            listener.begin();
            watch(Rc::clone(listener));
            heatpath_cli::heatpath(words)?;
            // There are no scalar outputs, so there is nothing to return.
            if let Some(file) = return_parameters {
                write_atomically(file, true, |_| Ok(()))?;
            }
            listener.end();
        }
    }
    Ok(())
}

/// Tells a listener the finished part; a second stage of the work, which begins at 0 again, is told from where
/// it passes the first.
fn watch(listener: Rc<dyn Listener>) {
    let farthest = Cell::new(0.0);
    heatpath_cli::watch(move |finished| {
        farthest.set(finished.max(farthest.get()));
        listener.tell(farthest.get())
    });
}

/// Prints with a single write, so that no host reads half of it.
fn print(text: &str) {
    // If standard output is closed there is nobody to tell.
    drop(io::stdout().lock().write_all(text.as_bytes()));
}
