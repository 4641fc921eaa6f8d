//! How a host learns how far a module is.

use crate::print;
use std::cell::Cell;
use std::ops::ControlFlow;
use std::rc::Rc;
use std::time::Instant;

/// Who is told.
pub(crate) trait Listener {
    /// The work begins.
    fn begin(&self);

    /// A part of it, from 0 to 1 and never falling, is finished; the answer says whether to go on.
    fn tell(&self, finished: f64) -> ControlFlow<()>;

    /// The work is done.
    fn end(&self);
}

/// The host at the other end of standard output.
pub(crate) struct Output {
    name: &'static str,
    start: Instant,
    /// The thousandths that were told last.
    told: Cell<u32>,
}

impl Output {
    pub(crate) fn listener(name: &'static str) -> Rc<dyn Listener> {
        Rc::new(Self { name, start: Instant::now(), told: Cell::new(0) })
    }
}

impl Listener for Output {
    fn begin(&self) {
        print(&format!(
            "<filter-start><filter-name>{}</filter-name>\
             <filter-comment>\"heatpath {}\"</filter-comment></filter-start>\n",
            self.name,
            env!("CARGO_PKG_VERSION")
        ));
    }

    fn tell(&self, finished: f64) -> ControlFlow<()> {
        let thousandths = (finished * 1000.0) as u32;
        if self.told.replace(thousandths) < thousandths {
            let part = f64::from(thousandths) / 1000.0;
            print(&format!("<filter-progress>{part}</filter-progress>\n"));
        }
        ControlFlow::Continue(())
    }

    fn end(&self) {
        let seconds = self.start.elapsed().as_secs_f64();
        print(&format!(
            "<filter-end><filter-name>{}</filter-name>\
             <filter-time>{seconds:.3}</filter-time></filter-end>\n",
            self.name
        ));
    }
}
