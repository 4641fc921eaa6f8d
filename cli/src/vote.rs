//! `heatpath vote`

use crate::args::{VoteArgs, VotingMethodArg};
use crate::extraction::Extraction;
use crate::failure::Failure;
use crate::input::{Input, Picture, check_not_negative};
use crate::output;
use crate::run::run;
use crate::structure;
use heatpath_core::Exec;
use heatpath_core::grid::medium::Medium;
use heatpath_core::grid::skeleton::PruneOptions;
use heatpath_core::grid::voting::{
    self, Ends, FastMarchingVotingOptions, Growth, Method, Stop, Votes, VotingOptions,
};
use heatpath_core::grid::{Sources, Structure};
use heatpath_io::{
    FieldStyle, ImageFile, Overlay, check_dimension, graph_json, write_field, write_overlay,
};

pub(crate) fn vote(args: &VoteArgs) -> Result<(), Failure> {
    check_options(args)?;
    check_not_negative("--prune", args.prune)?;
    output::check(args.output.as_deref(), &Extraction::<2>::ENDINGS, &args.out)?;
    output::check_field("--density", args.density.as_deref(), args.output.as_deref(), &args.out)?;
    match Input::read(&args.picture, &[&args.sources.source])? {
        Input::Picture(file) => vote_in::<2>(args, file),
        Input::Volume(file) => vote_in::<3>(args, file),
    }
}

fn vote_in<const D: usize>(args: &VoteArgs, file: ImageFile) -> Result<(), Failure> {
    output::check_dimension(args.output.as_deref(), &args.out, D)?;
    if let Some(file) = &args.density {
        check_dimension(file, None, D)?;
    }
    let picture = Picture::<D>::new(&args.picture, file)?;
    let found = structure::find(&picture, &args.sources, &args.medium, &args.structure)?;
    let approach = Approach::new(args, &found)?;
    let votes = run("votes", (args.structure.threads, args.out.quiet), |exec| {
        approach.vote(&found.medium, &found.sources, exec)
    })?;
    let prune = PruneOptions { length: args.prune, ..PruneOptions::default() };
    let has_growth = matches!(approach, Approach::Heat(VotingOptions { growth: Some(_), .. }));
    let cells = if has_growth { votes.crossed() } else { votes.kept.clone() };
    let graph = found.graph(&cells).pruned(prune);
    let extraction = Extraction {
        graph: &graph,
        kept: &votes.kept,
        seeds: found.sources.points(),
        placement: picture.placement,
    };
    // === Write
    if let Some(output) = &args.output {
        extraction.write(output, &args.out)?;
    }
    if let Some(file) = &args.density {
        let density = votes.density.map(|&votes| f64::from(votes));
        let style = FieldStyle { title: Some("votes".to_owned()), placement: picture.placement };
        write_field(file, None, args.out.force, &density, &style)?;
    }
    if let Some(overlay) = &args.out.overlay {
        // Votes span powers of ten.
        let heat_map = votes.density.map(|&n| if n > 0 { f64::from(n).ln() } else { f64::NAN });
        let paths = extraction.paths();
        let layers = Overlay {
            field: Some(&heat_map),
            paths: &paths,
            sources: extraction.seeds,
            are_pieces: true,
            ..Overlay::default()
        };
        write_overlay(overlay, args.out.force, &picture.image, &layers)?;
    }
    // === Report
    if args.out.json {
        output::print_json(&graph_json(&graph, extraction.seeds, picture.placement))?;
    }
    output::tell(&args.out, &line(&votes, &extraction));
    Ok(())
}

/// Refuses options that would do nothing.
fn check_options(args: &VoteArgs) -> Result<(), Failure> {
    let is_heat = !matches!(args.method, VotingMethodArg::Random | VotingMethodArg::Border);
    if is_heat && !args.no_growth && args.threshold.is_some() {
        return Err(Failure::usage(
            "--threshold needs --no-growth or fast marching: with growth --least-votes decides",
        ));
    }
    let of_heat = [
        ("--no-growth", args.no_growth),
        ("--gap", args.gap.is_some()),
        ("--least-votes", args.least_votes.is_some()),
        ("--level", args.level.is_some()),
        ("--settled", args.settled.is_some()),
        ("--iterations", args.iterations.is_some()),
    ];
    match of_heat.into_iter().find(|&(_, is_given)| is_given && !is_heat) {
        Some((option, _)) => Err(Failure::usage(format!(
            "{option} is of heat: votes by fast marching (`--method random`, `border`) do not take it"
        ))),
        None => Ok(()),
    }
}

/// How votes come about.
enum Approach {
    Heat(VotingOptions),
    FastMarching(FastMarchingVotingOptions),
}

impl Approach {
    fn new<const D: usize>(args: &VoteArgs, found: &Structure<D>) -> Result<Self, Failure> {
        let ends = match args.method {
            VotingMethodArg::Front => return Self::heat(args, Method::Front, found),
            VotingMethodArg::Multiple => return Self::heat(args, Method::Multiple, found),
            VotingMethodArg::Accumulated => return Self::heat(args, Method::Accumulated, found),
            VotingMethodArg::Random => Ends::Random { count: 500, seed: 0 },
            VotingMethodArg::Border => Ends::Border,
        };
        let usual = FastMarchingVotingOptions::default();
        let threshold = args.threshold.unwrap_or(usual.threshold);
        Ok(Self::FastMarching(FastMarchingVotingOptions { ends, threshold, ..usual }))
    }

    fn heat<const D: usize>(
        args: &VoteArgs,
        method: Method,
        found: &Structure<D>,
    ) -> Result<Self, Failure> {
        let growth = if args.no_growth { None } else { Some(Growth::new(found.level()?)) };
        let growth = growth.map(|usual| Growth {
            gap: args.gap.unwrap_or(usual.gap),
            least_votes: args.least_votes.unwrap_or(usual.least_votes),
            ..usual
        });
        Ok(Self::Heat(VotingOptions {
            method,
            steps: args.iterations,
            threshold: args.threshold,
            level: args.level,
            settled_share: args.settled,
            growth,
            ..VotingOptions::default()
        }))
    }

    fn vote<const D: usize>(
        &self,
        medium: &Medium<D>,
        sources: &Sources<D>,
        exec: &Exec,
    ) -> Result<Votes<D>, Failure> {
        Ok(match self {
            Self::Heat(options) => voting::vote(medium, sources, options, exec)?,
            Self::FastMarching(options) => {
                voting::vote_by_fast_marching(medium, sources, options, exec)?
            }
        })
    }
}

/// The result in words.
fn line<const D: usize>(votes: &Votes<D>, extraction: &Extraction<'_, D>) -> String {
    let stopped = match votes.stopped {
        Stop::LargestShare => "enough of the picture was kept",
        Stop::Settled => "little was new",
        Stop::Rounds => "these were all",
    };
    let kept = votes.kept.values().iter().filter(|&&kept| kept).count();
    let graph = extraction.graph;
    format!(
        "seeds: {}, rounds: {} ({stopped}): {kept} pixels kept, {} branches of {:.1} in all",
        extraction.seeds.len(),
        votes.rounds.len(),
        graph.branches.len(),
        graph.physical_length()
    )
}
