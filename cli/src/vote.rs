//! `heatpath vote`

use crate::args::{VoteArgs, VotingMethodArg};
use crate::extraction::Extraction;
use crate::failure::Failure;
use crate::input::{Input, Picture};
use crate::output;
use crate::run::run;
use crate::structure::Structure;
use heatpath_core::Exec;
use heatpath_core::grid::Sources;
use heatpath_core::grid::medium::Medium;
use heatpath_core::grid::skeleton::PruneOptions;
use heatpath_core::grid::voting::{
    self, Ends, FastMarchingVotingOptions, Growth, Method, Stop, Votes, VotingOptions,
};
use heatpath_io::{
    FieldStyle, ImageFile, Overlay, check_dimension, graph_json, write_field, write_overlay,
};

pub(crate) fn vote(args: &VoteArgs) -> Result<(), Failure> {
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
    let found = Structure::find(&picture, &args.sources, &args.medium, &args.structure)?;
    let approach = Approach::new(args, found.least_speed_sq)?;
    let votes = run("votes", (args.structure.threads, args.out.quiet), |exec| {
        approach.vote(&found.medium, &found.sources, exec)
    })?;
    let prune = PruneOptions { length: args.prune, ..PruneOptions::default() };
    let cells = if args.no_growth { votes.kept.clone() } else { votes.crossed() };
    let graph = found.graph(&cells).pruned(prune);
    let extraction = Extraction { graph: &graph, kept: &votes.kept, seeds: found.sources.points() };
    // === Write
    if let Some(output) = &args.output {
        extraction.write(output, &args.out)?;
    }
    if let Some(file) = &args.density {
        let density = votes.density.map(|&votes| f64::from(votes));
        let style = FieldStyle { title: Some("votes".to_owned()) };
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
        output::print_json(&graph_json(&graph, extraction.seeds))?;
    }
    output::tell(&args.out, &line(&votes, &extraction));
    Ok(())
}

/// How votes come about.
enum Approach {
    Heat(VotingOptions),
    FastMarching(FastMarchingVotingOptions),
}

impl Approach {
    fn new(args: &VoteArgs, least_speed_sq: f64) -> Result<Self, Failure> {
        let fast_marching = |ends| {
            let usual = FastMarchingVotingOptions::default();
            let threshold = args.threshold.unwrap_or(usual.threshold);
            Self::FastMarching(FastMarchingVotingOptions { ends, threshold, ..usual })
        };
        let heat = |method| {
            let usual = Growth::new(least_speed_sq);
            let growth = Growth {
                gap: args.gap.unwrap_or(usual.gap),
                least_votes: args.least_votes.unwrap_or(usual.least_votes),
                ..usual
            };
            Self::Heat(VotingOptions {
                method,
                steps: args.iterations,
                threshold: args.threshold,
                level: args.level,
                settled_share: args.settled,
                growth: (!args.no_growth).then_some(growth),
                ..VotingOptions::default()
            })
        };
        let approach = match args.method {
            VotingMethodArg::Front => heat(Method::Front),
            VotingMethodArg::Multiple => heat(Method::Multiple),
            VotingMethodArg::Accumulated => heat(Method::Accumulated),
            VotingMethodArg::Random => fast_marching(Ends::Random { count: 500, seed: 0 }),
            VotingMethodArg::Border => fast_marching(Ends::Border),
        };
        let is_heat = matches!(approach, Self::Heat(_));
        if !is_heat && (args.no_growth || args.level.is_some() || args.iterations.is_some()) {
            return Err(Failure::usage(
                "--no-growth, --level and --iterations are of heat: votes by fast marching (`--method \
                 random`, `border`) take none",
            ));
        }
        Ok(approach)
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
        "{} seeds, {} rounds ({stopped}): {kept} pixels kept, {} branches of {:.1} in all",
        extraction.seeds.len(),
        votes.rounds.len(),
        graph.branches.len(),
        graph.physical_length()
    )
}
