//! Geodesic voting.

use super::graph::{HP_STOP_LARGEST_SHARE, HP_STOP_ROUNDS, HP_STOP_SETTLED, hp_graph};
use super::options::{
    HP_VOTES_ACCUMULATED, HP_VOTES_BORDER, HP_VOTES_FRONT, HP_VOTES_MULTIPLE, HP_VOTES_RANDOM,
    hp_vote_options,
};
use super::start::{Look, chosen, start};
use crate::buffer::hp_buffer;
use crate::handles::hand_out;
use crate::options::hp_options;
use crate::pixels;
use crate::problem::Arguments;
use crate::scene::MEDIUM_SHARE;
use crate::settings::{Settings, number, unknown};
use crate::status::{Failure, guard, hp_status};
use crate::structs;
use crate::view::{self, View};
use heatpath_core::grid::skeleton::PruneOptions;
use heatpath_core::grid::voting::{
    Ends, FastMarchingVotingOptions, Growth, Method, Stop, Votes, VotingOptions, vote,
    vote_by_fast_marching,
};
use heatpath_core::grid::{Grid, Structure};

/// How votes come about.
enum Ballot {
    Heat(VotingOptions),
    FastMarching(FastMarchingVotingOptions),
}

/// Finds the curves of an image by the votes of many minimal paths (section 4.1 of the paper), as a graph
/// with radii.
///
/// image, mask, sources, source_count and options are those of hp_distance(), of which medium, range,
/// threads and progress count. Without sources (NULL, 0) there is a seed in each long piece of the
/// structure.
///
/// vote_options: NULL for the defaults.
///
/// density: receives the number of paths through each pixel; of the same size, HP_F32 or HP_F64. NULL
/// if it is not wanted.
///
/// kept: receives 255 in the pixels of the curves and 0 elsewhere; of the same size, HP_U8. NULL if it
/// is not wanted.
///
/// graph: receives the curves, to be freed with hp_graph_free(), or NULL if anything but HP_OK is
/// returned.
///
/// HP_NO_ANSWER is returned if there are no sources and the image shows no structure to put them on.
///
/// # Safety
/// The structs are as large as their `struct_size` says, and buffers and points are as large as
/// their description. The results are not used by another thread meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_votes_create(
    image: *const hp_buffer,
    mask: *const hp_buffer,
    sources: *const f64,
    source_count: u64,
    options: *const hp_options,
    vote_options: *const hp_vote_options,
    density: *const hp_buffer,
    kept: *const hp_buffer,
    graph: *mut *mut hp_graph,
) -> hp_status {
    let arguments = Arguments { image, mask, sources, source_count, options };
    let targets = (density, kept);
    // SAFETY: the caller's promise.
    let make = || unsafe {
        match view::dimension(image)? {
            2 => find::<2>(&arguments, vote_options, targets),
            _ => find::<3>(&arguments, vote_options, targets),
        }
    };
    // SAFETY: the caller promises room for a pointer.
    guard(|| unsafe { hand_out(graph, "graph", make) })
}

/// # Safety
/// As [`hp_votes_create`].
unsafe fn find<const D: usize>(
    arguments: &Arguments,
    vote_options: *const hp_vote_options,
    (density, kept): (*const hp_buffer, *const hp_buffer),
) -> Result<hp_graph, Failure> {
    // SAFETY: the caller's promise, for each of the pointers.
    let (options, settings, image, density, kept) = unsafe {
        let options = structs::read_or_defaults(vote_options, "vote_options")?;
        let settings = Settings::read(arguments.options)?;
        let image = View::<D>::read(arguments.image, "image")?;
        let [density, kept] = [View::optional(density, "density"), View::optional(kept, "kept")];
        (options, settings, image, density?, kept?)
    };
    for view in density.iter().chain(&kept) {
        view.check_size(&image.shape)?;
    }
    density.as_ref().map_or(Ok(()), pixels::check_writable)?;
    kept.as_ref().map_or(Ok(()), pixels::check_mask)?;
    let look = options.look().map_err(|failure| failure.of("vote_options"))?;
    let exec = settings.run.exec()?;
    // SAFETY: the caller's promise.
    let found = unsafe { start::<D>(arguments, &settings, look, &exec.part(0.0, MEDIUM_SHARE))? };
    let ballot = options.ballot(&found).map_err(|failure| failure.of("vote_options"))?;
    let exec = exec.part(MEDIUM_SHARE, 1.0);
    let votes = match &ballot {
        Ballot::Heat(options) => vote(&found.medium, &found.sources, options, &exec)?,
        Ballot::FastMarching(options) => {
            vote_by_fast_marching(&found.medium, &found.sources, options, &exec)?
        }
    };
    let prune = PruneOptions { length: options.prune, ..PruneOptions::default() };
    let graph = found.graph(&ballot.curves(&votes)).pruned(prune);
    settings.run.finish()?;
    // === Results
    let counts: Vec<f64> = votes.density.values().iter().map(|&count| f64::from(count)).collect();
    // SAFETY: the caller promises that the pixels can be written; their types were checked.
    unsafe {
        density.iter().for_each(|view| pixels::write(view, &counts));
        kept.iter().for_each(|view| pixels::write_mask(view, votes.kept.values()));
    }
    let stop = match votes.stopped {
        Stop::LargestShare => HP_STOP_LARGEST_SHARE,
        Stop::Settled => HP_STOP_SETTLED,
        Stop::Rounds => HP_STOP_ROUNDS,
    };
    Ok(hp_graph::of_skeleton(&graph, found.sources.points(), stop, votes.rounds.len()))
}

impl Ballot {
    /// The cells of the curves: with growth all that votes crossed hang together.
    fn curves<const D: usize>(&self, votes: &Votes<D>) -> Grid<bool, D> {
        match self {
            Self::Heat(VotingOptions { growth: Some(_), .. }) => votes.crossed(),
            _ => votes.kept.clone(),
        }
    }
}

impl hp_vote_options {
    fn look(&self) -> Result<Look, Failure> {
        if !(self.prune.is_finite() && self.prune >= 0.0) {
            let message = format!("prune is {}; it must be finite and 0 or more", self.prune);
            return Err(Failure::argument(message));
        }
        Look::new(self.structure, self.extent)
    }

    fn ballot<const D: usize>(&self, found: &Structure<D>) -> Result<Ballot, Failure> {
        match self.method {
            HP_VOTES_ACCUMULATED => self.heat(Method::Accumulated, found),
            HP_VOTES_FRONT => self.heat(Method::Front, found),
            HP_VOTES_MULTIPLE => self.heat(Method::Multiple, found),
            HP_VOTES_RANDOM => Ok(self.fast_marching(Ends::Random { count: 500, seed: 0 })),
            HP_VOTES_BORDER => Ok(self.fast_marching(Ends::Border)),
            other => Err(unknown("method", other, "one of HP_VOTES_... (0 to 4)")),
        }
    }

    fn heat<const D: usize>(
        &self,
        method: Method,
        found: &Structure<D>,
    ) -> Result<Ballot, Failure> {
        let growth = if self.no_growth == 0 { Some(Growth::new(found.level()?)) } else { None };
        let growth = growth.map(|usual| Growth {
            gap: chosen(self.gap).unwrap_or(usual.gap),
            least_votes: if self.least_votes == 0 { usual.least_votes } else { self.least_votes },
            ..usual
        });
        Ok(Ballot::Heat(VotingOptions {
            method,
            steps: (self.iterations > 0).then(|| number(self.iterations, 0)),
            threshold: chosen(self.threshold),
            level: chosen(self.level),
            settled_share: chosen(self.settled),
            growth,
            ..VotingOptions::default()
        }))
    }

    fn fast_marching(&self, ends: Ends) -> Ballot {
        let usual = FastMarchingVotingOptions::default();
        let threshold = chosen(self.threshold).unwrap_or(usual.threshold);
        Ballot::FastMarching(FastMarchingVotingOptions { ends, threshold, ..usual })
    }
}
