//! Paths along an observer's vessels of the retina, by every medium and readout: tables in Markdown.
//!
//! `cargo run --release -p heatpath-benches --bin paths -- DATA [MEDIUM] [SOURCES] [LENGTH]`, where the
//! folder DATA holds `retina_chase` and `retina_stare`, each with `images`, `centerline` and `fov_png`.
//! Rows are those whose medium's name begins with MEDIUM, by default all; SOURCES is the number of
//! sources in a picture, by default 1, and LENGTH that of the ways in pixels, by default 200. What is
//! measured and what comes out stands in `docs/extraction.md`.
#![allow(clippy::print_stdout, reason = "the tables are what this program is for")]

mod data;
mod methods;
mod pairs;
mod readouts;

use data::{DataSet, Picture, SETS};
use heatpath_core::Exec;
use heatpath_core::evaluation::{CurveSet, evaluate};
use heatpath_core::grid::heat::HeatError;
use heatpath_core::grid::medium::Medium;
use methods::Kind;
use pairs::{Ways, ways};
use readouts::{Readout, Traced, Window};
use std::error::Error;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use std::{env, thread};

type Failure = Box<dyn Error + Send + Sync>;

/// In pixels.
const TOLERANCES: [f64; 3] = [1.0, 2.0, 3.0];

/// How straight ways are: the distance of their ends over their length.
const STRAIGHTNESS: f64 = 0.7;

fn main() -> Result<(), Failure> {
    let data = PathBuf::from(env::args().nth(1).ok_or("the data's folder is missing")?);
    let medium = env::args().nth(2).unwrap_or_default();
    let sources = env::args().nth(3).map_or(Ok(1), |count| count.parse())?;
    let length = env::args().nth(4).map_or(Ok(200.0), |length| length.parse())?;
    let mut rows = methods::all();
    rows.retain(|(kind, _)| kind.name().starts_with(&medium));
    for set in SETS {
        let parts = in_parallel(&set.names(&data)?, |name| {
            let exec = Exec::single_threaded();
            of_picture(&set.read(&data, name, &exec)?, length, sources, &rows, &exec)
        })?;
        print_table(&set, length, &rows, &parts);
    }
    Ok(())
}

/// What was found in one picture, for each row of the table.
type Part = (bool, Vec<Tally>);

/// The results of `work` for each of `names`, in their order.
fn in_parallel(
    names: &[String],
    work: impl Fn(&str) -> Result<Part, Failure> + Sync,
) -> Result<Vec<Part>, Failure> {
    let (next, results) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let threads = thread::available_parallelism()?.get();
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some((i, name)) = {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    names.get(i).map(|name| (i, name))
                } {
                    let result = work(name);
                    results.lock().expect("no thread panics").push((i, result));
                }
            });
        }
    });
    let mut results = results.into_inner()?;
    results.sort_by_key(|&(i, _)| i);
    results.into_iter().map(|(_, result)| result).collect()
}

fn of_picture(
    picture: &Picture,
    length: f64,
    sources: usize,
    rows: &[(Kind, Readout)],
    exec: &Exec,
) -> Result<Part, Failure> {
    let ways = ways(&picture.centrelines, length, sources, STRAIGHTNESS);
    let vessels = methods::ISOTROPIC.medium(picture, &[], exec)?;
    let mut tallies = Vec::new();
    for rows in rows.chunk_by(|a, b| a.0 == b.0) {
        tallies.extend(of_medium((picture, &vessels), &ways, length, rows, exec)?);
    }
    Ok((picture.chosen_by, tallies))
}

/// What is found by `rows` of the same medium; isotropic vesselness comes with the picture.
fn of_medium(
    (picture, vessels): (&Picture, &Medium<2>),
    ways: &[Ways],
    length: f64,
    rows: &[(Kind, Readout)],
    exec: &Exec,
) -> Result<Vec<Tally>, Failure> {
    let mut tallies = vec![Tally::default(); rows.len()];
    let kind = rows[0].0;
    let groups = if kind.depends_on_source() { 1 } else { ways.len().max(1) };
    for ways in ways.chunks(groups) {
        let reference = picture.grey.sample(ways[0].source);
        let medium = kind.medium(picture, &[reference], exec)?;
        for ways in ways {
            let window = Window::new(&medium, vessels, ways, length);
            for (&(_, readout), tally) in rows.iter().zip(&mut tallies) {
                tally.add_ways(&window, ways, readout, exec)?;
            }
        }
    }
    Ok(tallies)
}

/// Lengths in pixels, summed up over paths.
#[derive(Clone, Debug, Default)]
struct Tally {
    truth: f64,
    path: f64,
    /// Of the truth and of the path, what is within each tolerance of the other.
    within: [[f64; 2]; TOLERANCES.len()],
    paths: usize,
    lost: usize,
    sources: usize,
    time: Duration,
}

impl Tally {
    fn add_ways(
        &mut self,
        window: &Window,
        ways: &Ways,
        readout: Readout,
        exec: &Exec,
    ) -> Result<(), Failure> {
        let start = Instant::now();
        let traced = match readout.paths(window, ways, exec) {
            // The medium is too slow for explicit heat: its paths are lost, and other rows go on.
            Err(error) if matches!(error.downcast_ref(), Some(HeatError::Range)) => {
                Traced::none(ways)
            }
            traced => traced?,
        };
        self.time += start.elapsed();
        self.sources += 1;
        self.lost += traced.lost;
        traced.paths.iter().zip(&ways.truths).try_for_each(|(path, truth)| self.add(path, truth))
    }

    fn add(&mut self, path: &[[f64; 2]], truth: &[[f64; 2]]) -> Result<(), Failure> {
        let [path, truth] = [path, truth].map(|points| CurveSet::of_polylines(&[points], [1.0; 2]));
        let found = evaluate(&path?, &truth?, &TOLERANCES, None)?;
        for (within, score) in self.within.iter_mut().zip(&found.scores) {
            within[0] += score.recall * score.truth_length;
            within[1] += score.precision * score.extracted_length;
        }
        self.truth += found.scores[0].truth_length;
        self.path += found.scores[0].extracted_length;
        self.paths += 1;
        Ok(())
    }

    fn sum<'a>(tallies: impl Iterator<Item = &'a Self>) -> Self {
        tallies.fold(Self::default(), |mut sum, tally| {
            sum.truth += tally.truth;
            sum.path += tally.path;
            for (sum, within) in sum.within.iter_mut().zip(&tally.within) {
                (0..2).for_each(|i| sum[i] += within[i]);
            }
            sum.paths += tally.paths;
            sum.lost += tally.lost;
            sum.sources += tally.sources;
            sum.time += tally.time;
            sum
        })
    }

    /// Recall and precision in per cent.
    fn scores(&self, tolerance: usize) -> String {
        if self.paths == 0 {
            return "no paths".into();
        }
        let [truth, path] = self.within[tolerance];
        format!("{:.1} / {:.1}", 100.0 * truth / self.truth, 100.0 * path / self.path)
    }
}

fn print_table(set: &DataSet, length: f64, rows: &[(Kind, Readout)], parts: &[Part]) {
    let of_row = |row: usize, half: Option<bool>| {
        let counts = move |part: &&Part| half.is_none_or(|half| part.0 == half);
        Tally::sum(parts.iter().filter(counts).map(|part| &part.1[row]))
    };
    let paths = of_row(0, None).paths;
    println!("\n{}, {length} pixels, {} pictures, {paths} paths\n", set.name, parts.len());
    println!("| medium | readout | 1 px | 2 px | 3 px | 2 px, chosen by | 2 px, others | ms |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for (row, (kind, readout)) in rows.iter().enumerate() {
        let all = of_row(row, None);
        let halves = [true, false].map(|half| of_row(row, Some(half)).scores(1));
        let scores = [0, 1, 2].map(|tolerance| all.scores(tolerance)).join(" | ");
        let lost = if all.lost > 0 { format!(" ({} lost)", all.lost) } else { String::new() };
        let time = 1e3 * all.time.as_secs_f64() / all.sources as f64;
        let (medium, readout, halves) = (kind.name(), readout.name(), halves.join(" | "));
        println!("| {medium} | {readout}{lost} | {scores} | {halves} | {time:.0} |");
    }
}
