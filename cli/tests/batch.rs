//! Many inputs at once, as a user runs them, also when everything is killed.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::Bench;
use image::{GrayImage, Luma};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Pictures `0.png`, `1.png` and so on, each of another curve.
fn write_pictures(bench: &Bench, count: usize, side: u32) {
    for number in 0..count {
        let phase = number as f64;
        GrayImage::from_fn(side, side, |x, y| {
            let curve = f64::from(side) * (0.5 + 0.2 * (0.1 * f64::from(x) + phase).sin());
            Luma([if (f64::from(y) - curve).abs() < 2.5 { 220 } else { 60 }])
        })
        .save(bench.path(&format!("{number}.png")))
        .unwrap();
    }
}

/// A manifest of paths through `count` pictures, each with two outputs.
fn write_manifest(bench: &Bench, count: usize, more: &str) {
    let rows = (0..count).map(|number| format!("[[row]]\ninput = '{number}.png'\n"));
    let defaults = "[defaults]\ncommand = 'path'\nsource = '2,20'\nend = [[30, 20], [25, 10]]\n\
                    output = 'out/{stem}.json'\noverlay = 'out/{stem}.png'\n";
    let text = format!("{defaults}{more}\n{}", rows.collect::<String>());
    fs::write(bench.path("m.toml"), text).unwrap();
}

/// The names and contents of the files in a folder.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.map(|path| (path.file_name().unwrap().into(), fs::read(&path).unwrap())).collect()
}

fn records(bench: &Bench, log: &str) -> Vec<Value> {
    let text = fs::read_to_string(bench.path(log)).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn rows(records: &[Value]) -> Vec<u64> {
    let mut rows: Vec<u64> = records.iter().map(|record| record["row"].as_u64().unwrap()).collect();
    rows.sort_unstable();
    rows
}

fn start(bench: &Bench, arguments: &str) -> Child {
    Command::new(env!("CARGO_BIN_EXE_heatpath"))
        .current_dir(bench.path("."))
        .args(arguments.split_whitespace())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

#[test]
fn rows_are_what_the_commands_would_have_written() {
    let bench = Bench::new();
    write_pictures(&bench, 3, 40);
    write_manifest(&bench, 3, "");
    let answer = bench.json("batch m.toml --jobs 2 --json");
    assert_eq!(
        (&answer["rows"], &answer["done"], &answer["failed"]),
        (&3.into(), &3.into(), &0.into())
    );
    bench.ok("path 1.png --source 2,20 --end 30,20 --end 25,10 -o 1.json --overlay 1.over.png");
    let out = contents(&bench.path("out"));
    assert_eq!(out.len(), 6);
    assert_eq!(out[Path::new("1.json")], fs::read(bench.path("1.json")).unwrap());
    assert_eq!(out[Path::new("1.png")], fs::read(bench.path("1.over.png")).unwrap());
    // === The log
    let records = records(&bench, "m.log.jsonl");
    assert_eq!(rows(&records), [1, 2, 3]);
    for record in &records {
        assert_eq!((&record["status"], &record["exit_code"]), (&"done".into(), &0.into()));
        assert_eq!(record["answer"]["paths"].as_array().unwrap().len(), 2);
        assert!(record["answer"]["paths"][0]["points"].is_null(), "they are in the file");
        assert!(record["seconds"].as_f64().unwrap() > 0.0);
    }
    // === The summary
    let summary = fs::read_to_string(bench.path("m.summary.csv")).unwrap();
    let lines: Vec<&str> = summary.lines().collect();
    assert_eq!(lines.len(), 4);
    assert!(
        lines[0]
            .starts_with("row,name,command,status,exit_code,seconds,input,output,curves,length")
    );
    assert!(
        lines[2].starts_with("2,1.png,path,done,0,") && lines[2].contains("1.png,out/1.json,2,")
    );
    // === Nothing else
    let names: Vec<_> = bench
        .files()
        .iter()
        .filter(|path| path.to_string_lossy().contains("m."))
        .cloned()
        .collect();
    let expected = ["m.log.jsonl", "m.summary.csv", "m.toml"].map(|name| bench.path(name));
    assert_eq!(names, expected);
}

/// The same rows as TOML and as CSV.
#[test]
fn csv_says_the_same() {
    let bench = Bench::new();
    write_pictures(&bench, 2, 40);
    write_manifest(&bench, 2, "power = 6\nquality = 1");
    bench.fails("batch m.toml", 3, &["m.toml", "`quality`", "no row"]);
    write_manifest(&bench, 2, "power = 6");
    bench.ok("batch m.toml --quiet");
    let toml = contents(&bench.path("out"));
    fs::write(
        bench.path("m.csv"),
        "command,input,source,end,output\npath,0.png,\"2,20\",\"30,20; 25,10\",csv/0.json\n\
         path,1.png,\"2,20\",\"30,20; 25,10\",csv/{stem}.json\n",
    )
    .unwrap();
    bench.ok("batch m.csv --quiet --default power=6 --log c.jsonl --summary c.csv");
    let csv = contents(&bench.path("csv"));
    assert_eq!(csv.len(), 2);
    for (name, bytes) in csv {
        assert_eq!(toml[&name], bytes);
    }
}

#[test]
fn mistakes_are_refused_before_anything_starts() {
    let bench = Bench::new();
    write_pictures(&bench, 2, 40);
    let row = "[[row]]\ncommand = 'path'\ninput = '0.png'\nsource = '2,20'\nend = '30,20'\n";
    let refuse = |text: &str, code, words: &[&str]| {
        fs::write(bench.path("m.toml"), text).unwrap();
        bench.fails("batch m.toml --report r.html", code, words);
    };
    let with = |more: &str| format!("{row}output = 'a.json'\n{row}output = 'b.json'\n{more}");
    refuse(&with("zource = '1,2'"), 3, &["row 2", "--zource", "--source"]);
    refuse(&with("medium = 'tubes'"), 3, &["row 2", "tubes", "vesselness"]);
    refuse(&with("power = true"), 3, &["row 2", "`power`", "value"]);
    refuse(&with("json = true"), 3, &["row 2", "`json`"]);
    refuse(&with("truth = '1.png'"), 3, &["row 2", "`tolerance`"]);
    refuse(&with("overlay = './a.json'"), 3, &["row 2", "a.json", "row 1"]);
    refuse(&with("overlay = 'm.toml'"), 3, &["row 2", "m.toml", "the batch itself"]);
    refuse(&with("mask = 'a.json'"), 3, &["row 2", "a.json", "row 1", "wait"]);
    refuse(row, 3, &["row 1", "required", "--output"]);
    refuse("[[row]]\ncommand = 'paint'", 3, &["row 1", "paint", "keypoints"]);
    refuse("[[row]]\ninput = '0.png'", 3, &["row 1", "`command`", "mesh path"]);
    refuse(&format!("[defaults]\ndensity = 'd.npy'\n{}", with("")), 3, &["`density`", "no row"]);
    refuse("[[rows]]\na = 1", 3, &["line 1", "rows"]);
    refuse("", 3, &["no rows"]);
    refuse(&with("overlay = '1.png'"), 4, &["row 2", "1.png already exists", "--force"]);
    bench.fails("batch none.toml", 4, &["none.toml", "cannot be read"]);
    fs::write(bench.path("m.txt"), "").unwrap();
    bench.fails("batch m.txt", 3, &["m.txt", ".toml or .csv"]);
    fs::write(bench.path("m.toml"), with("")).unwrap();
    bench.fails("batch m.toml --log m.toml --force", 2, &["m.toml"]);
    bench.fails("batch m.toml --summary 0.png", 2, &["0.png", "ending"]);
    assert_eq!(bench.run("batch m.toml --shard 3/2").status.code(), Some(2));
    assert_eq!(bench.run("batch m.toml --jobs 0").status.code(), Some(2));
    assert_eq!(bench.run("batch m.toml --resume --force").status.code(), Some(2));
}

#[test]
fn failed_rows_are_counted_and_only_they_are_run_again() {
    let bench = Bench::new();
    write_pictures(&bench, 3, 40);
    fs::copy(bench.path("1.png"), bench.path("kept.png")).unwrap();
    fs::write(bench.path("1.png"), "no picture").unwrap();
    fs::remove_file(bench.path("2.png")).unwrap();
    write_manifest(&bench, 3, "");
    let output = bench.run("batch m.toml");
    assert_eq!(output.status.code(), Some(12), "two failed");
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("3 rows: 1 done, 2 failed") && said.contains("row 2 (1.png)"), "{said}");
    let first = records(&bench, "m.log.jsonl");
    assert_eq!(rows(&first), [1, 2, 3]);
    assert_eq!((&first[1]["exit_code"], &first[2]["exit_code"]), (&3.into(), &4.into()));
    assert!(
        first[1]["message"].as_str().unwrap().contains("1.png: the content is not a known picture")
    );
    // === Nothing is left to do for --resume
    let answer =
        |output: &std::process::Output| serde_json::from_slice::<Value>(&output.stdout).unwrap();
    let output = bench.run("batch m.toml --resume --json");
    assert_eq!((output.status.code(), &answer(&output)["unchanged"]), (Some(12), &3.into()));
    // === An input that has changed is another one
    fs::rename(bench.path("kept.png"), bench.path("1.png")).unwrap();
    let output = bench.run("batch m.toml --resume --json");
    assert_eq!((output.status.code(), &answer(&output)["unchanged"]), (Some(11), &2.into()));
    let output = bench.run("batch m.toml --retry-failed --json");
    assert_eq!((output.status.code(), &answer(&output)["unchanged"]), (Some(11), &2.into()));
    assert_eq!(rows(&records(&bench, "m.log.jsonl")), [1, 2, 2, 3, 3]);
    // === Without --resume the log is in the way
    bench.fails("batch m.toml --summary s.csv", 4, &["m.toml", "out/0.json", "--force"]);
    fs::remove_dir_all(bench.path("out")).unwrap();
    bench.fails("batch m.toml --summary s.csv", 4, &["m.log.jsonl", "--resume", "--force"]);
}

#[test]
fn what_has_changed_is_run_again() {
    let bench = Bench::new();
    write_pictures(&bench, 3, 40);
    write_manifest(&bench, 3, "");
    bench.ok("batch m.toml --quiet");
    let unchanged = |arguments: &str| {
        bench.json(&format!("batch m.toml --resume --json {arguments}"))["unchanged"].clone()
    };
    assert_eq!(unchanged(""), 3);
    fs::remove_file(bench.path("out/0.json")).unwrap();
    fs::write(bench.path("out/1.png"), "cut off").unwrap();
    assert_eq!(unchanged(""), 1, "outputs that are not complete");
    assert_eq!(unchanged(""), 3);
    assert_eq!(unchanged("--default power=5"), 0, "other options");
    // A foreign file is never overwritten.
    fs::write(bench.path("mine.json"), "mine").unwrap();
    write_manifest(&bench, 3, "[[row]]\ninput = '0.png'\noutput = 'mine.json'\noverlay = 'o.png'");
    bench.fails("batch m.toml --resume", 4, &["row 1", "mine.json already exists"]);
    // A log is never taken for one.
    fs::write(bench.path("text.jsonl"), "some text").unwrap();
    bench.fails("batch m.toml --resume --log text.jsonl", 4, &["text.jsonl", "no log"]);
    fs::write(bench.path("text.jsonl"), "{}\n").unwrap();
    bench.fails("batch m.toml --resume --log text.jsonl", 3, &["text.jsonl", "line 1"]);
}

#[test]
fn shards_together_are_the_whole() {
    let bench = Bench::new();
    write_pictures(&bench, 7, 40);
    write_manifest(&bench, 7, "");
    for part in [2, 3, 1] {
        bench.ok(&format!("batch m.toml --shard {part}/3 --quiet --report r.html"));
    }
    let parts = [1, 2, 3].map(|part| rows(&records(&bench, &format!("m.log.{part}-of-3.jsonl"))));
    assert_eq!(parts, [vec![1, 4, 7], vec![2, 5], vec![3, 6]]);
    for name in ["m.summary.2-of-3.csv", "r.1-of-3.html"] {
        assert!(bench.path(name).exists(), "{name}");
    }
    // The whole gathers them, and so does another partition.
    let whole = bench.json("batch m.toml --resume --json --report r.html");
    assert_eq!((&whole["unchanged"], &whole["done"]), (&7.into(), &7.into()));
    assert_eq!(fs::read_to_string(bench.path("m.summary.csv")).unwrap().lines().count(), 8);
    assert_eq!(bench.json("batch m.toml --resume --shard 2/2 --json")["unchanged"], 3);
    let sharded = contents(&bench.path("out"));
    bench.ok("batch m.toml --force --quiet");
    assert_eq!(contents(&bench.path("out")), sharded);
}

#[test]
fn results_are_compared_with_the_truth() {
    let bench = Bench::new();
    write_pictures(&bench, 1, 60);
    fs::write(
        bench.path("m.toml"),
        "[[row]]\ncommand = 'path'\ninput = '0.png'\nsource = '2,31'\nend = '57,24'\npower = 6\n\
         output = 'p.json'\ntruth = '0.png'\ntolerance = [2, 4]\n\
         [[row]]\ncommand = 'evaluate'\nextracted = '0.png'\ntruth = '0.png'\ntolerance = 1\n",
    )
    .unwrap();
    bench.ok("batch m.toml --quiet");
    let records = records(&bench, "m.log.jsonl");
    let scores =
        bench.json("evaluate --extracted p.json --truth 0.png --tolerance 2 --tolerance 4 --json");
    assert_eq!(records[0]["scores"], scores);
    assert_eq!(records[1]["answer"]["recall"], 1.0);
    let summary = fs::read_to_string(bench.path("m.summary.csv")).unwrap();
    let header = summary.lines().next().unwrap();
    assert!(header.ends_with(
        "message,recall@1,precision@1,f1@1,recall@2,precision@2,f1@2,recall@4,precision@4,f1@4"
    ));
}

/// Numbers that look random and are the same in each run.
struct Moments(u64);

impl Moments {
    fn next(&mut self, below: u64) -> Duration {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        Duration::from_millis((self.0 >> 33) % below)
    }
}

/// Killed at ten moments, alone or with its rows, and resumed: the same files as without.
#[cfg(unix)]
#[test]
fn a_batch_that_is_killed_again_and_again_ends_the_same() {
    let bench = Bench::new();
    write_pictures(&bench, 30, 48);
    write_manifest(&bench, 30, "iterations = 800");
    let began = std::time::Instant::now();
    bench.ok("batch m.toml --quiet --jobs 2");
    let share = (began.elapsed().as_millis() as u64 / 4).max(1);
    let undisturbed = contents(&bench.path("out"));
    assert_eq!(undisturbed.len(), 60);
    fs::remove_dir_all(bench.path("out")).unwrap();
    fs::remove_file(bench.path("m.log.jsonl")).unwrap();
    fs::remove_file(bench.path("m.summary.csv")).unwrap();

    let mut moments = Moments(8);
    let mut killed = 0;
    for round in 0..10 {
        // Its own group, so that the rows can be killed with it.
        let mut child = std::os::unix::process::CommandExt::process_group(
            &mut Command::new(env!("CARGO_BIN_EXE_heatpath")),
            0,
        )
        .current_dir(bench.path("."))
        .args(["batch", "m.toml", "--resume", "--jobs", "2", "--quiet"])
        .spawn()
        .unwrap();
        sleep(Duration::from_millis(5) + moments.next(share));
        let whole_group = round % 2 == 0;
        let target = format!("{}{}", if whole_group { "-" } else { "" }, child.id());
        Command::new("kill").args(["-KILL", "--", &target]).stderr(Stdio::null()).status().unwrap();
        killed += usize::from(child.wait().unwrap().code().is_none());
    }
    println!("killed {killed} times, moments up to {share} ms");
    assert!(killed > 0, "each run was faster than a part of the first");
    bench.ok("batch m.toml --resume --jobs 2 --quiet");
    assert!(contents(&bench.path("out")) == undisturbed, "no other file, and no other content");
    assert_eq!(rows(&records(&bench, "m.log.jsonl")), (1..=30).collect::<Vec<_>>());
    assert!(!bench.path("m.log.jsonl.started").exists());
}

/// What a killed process leaves is removed, and a line of the log that was cut off is forgotten.
#[test]
fn leftovers_are_removed() {
    let bench = Bench::new();
    write_pictures(&bench, 2, 40);
    write_manifest(&bench, 2, "");
    bench.ok("batch m.toml --quiet");
    let expected = contents(&bench.path("out"));
    let log = fs::read_to_string(bench.path("m.log.jsonl")).unwrap();
    let first = log.find('\n').unwrap() + 1;
    fs::write(bench.path("m.log.jsonl"), &log[..first + 20]).unwrap();
    fs::write(bench.path("m.log.jsonl.started"), "[\"out/1.json\",\"out/1.png\"]\n[\"ou").unwrap();
    fs::write(bench.path("out/.1.json.heatpath-abcdef.part"), "half").unwrap();
    fs::write(bench.path(".m.summary.csv.heatpath-abcdef.part"), "half").unwrap();
    assert_eq!(bench.json("batch m.toml --resume --json")["unchanged"], 1);
    assert_eq!(contents(&bench.path("out")), expected);
    assert!(!bench.path(".m.summary.csv.heatpath-abcdef.part").exists());
    assert_eq!(rows(&records(&bench, "m.log.jsonl")), [1, 2]);
}

/// A row that crashes costs itself alone.
#[cfg(unix)]
#[test]
fn a_killed_row_is_one_failed_row() {
    let bench = Bench::new();
    write_pictures(&bench, 3, 40);
    write_manifest(
        &bench,
        3,
        "[[row]]\ninput = '0.png'\niterations = 100000000\noutput = 'l.json'\noverlay = 'l.png'",
    );
    let mut batch = start(&bench, "batch m.toml");
    let row = wait_for(|| child_of(batch.id()));
    Command::new("kill").args(["-KILL", &row]).status().unwrap();
    assert_eq!(batch.wait().unwrap().code(), Some(11));
    let records = records(&bench, "m.log.jsonl");
    assert_eq!(rows(&records), [1, 2, 3, 4]);
    assert!(
        records[0]["message"].as_str().unwrap().contains("killed"),
        "{}",
        records[0]["message"]
    );
}

/// Ctrl-C and requests to end reach the rows, and rows never outlive their batch.
#[cfg(unix)]
#[test]
fn rows_end_with_their_batch() {
    for (signal, code) in [("-INT", Some(130)), ("-TERM", Some(130)), ("-KILL", None)] {
        let bench = Bench::new();
        write_pictures(&bench, 2, 40);
        write_manifest(&bench, 2, "iterations = 100000000");
        let mut batch = start(&bench, "batch m.toml");
        let row = wait_for(|| child_of(batch.id()));
        Command::new("kill").args([signal, &batch.id().to_string()]).status().unwrap();
        assert_eq!(batch.wait().unwrap().code(), code);
        wait_for(|| (!is_running(&row)).then_some(()));
        assert!(contents(&bench.path("out")).is_empty(), "nothing was written");
        assert_eq!(records(&bench, "m.log.jsonl").len(), 0, "and nothing has ended");
    }
}

#[cfg(unix)]
#[test]
fn two_batches_do_not_share_a_log() {
    let bench = Bench::new();
    write_pictures(&bench, 1, 40);
    write_manifest(&bench, 1, "iterations = 100000000");
    let mut batch = start(&bench, "batch m.toml");
    wait_for(|| child_of(batch.id()));
    let output = bench.run("batch m.toml --resume");
    assert_eq!(output.status.code(), Some(4));
    assert!(String::from_utf8(output.stderr).unwrap().contains("another batch"));
    Command::new("kill").args(["-INT", &batch.id().to_string()]).status().unwrap();
    batch.wait().unwrap();
}

/// Waits for something that comes sooner or later.
#[cfg(unix)]
fn wait_for<T>(mut what: impl FnMut() -> Option<T>) -> T {
    for _ in 0..20_000 {
        if let Some(found) = what() {
            return found;
        }
        sleep(Duration::from_millis(5));
    }
    panic!("it did not come");
}

/// A process that this one has started.
#[cfg(unix)]
fn child_of(process: u32) -> Option<String> {
    let output = Command::new("ps").args(["-o", "pid=", "--ppid", &process.to_string()]).output();
    let text = String::from_utf8(output.unwrap().stdout).unwrap();
    text.split_whitespace().next().map(str::to_owned)
}

#[cfg(unix)]
fn is_running(process: &str) -> bool {
    let output = Command::new("ps").args(["-o", "stat=", "-p", process]).output().unwrap();
    let state = String::from_utf8(output.stdout).unwrap();
    !state.trim().is_empty() && !state.trim().starts_with('Z')
}
