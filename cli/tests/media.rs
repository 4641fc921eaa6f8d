//! Media of directions and tubes, and the heat method, through the command.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

use common::Bench;

/// The lowest cost of a picture of 100 x 80 pixels along a bright line that goes up and down once.
fn line(bench: &Bench) {
    bench.write_npy("line.npy", &[80, 100], |cell| {
        let (x, y) = ((cell % 100) as f64, (cell / 100) as f64);
        let off = y - 40.0 - 25.0 * (x / 16.0).sin();
        (-off * off / 8.0).exp()
    });
}

#[test]
fn tubes_are_found_and_followed() {
    let bench = Bench::new();
    line(&bench);
    let paths = |medium: &str| {
        let report = bench.json(&format!(
            "path line.npy --medium {medium} --source 3,44.7 --end 97,34.5 --estimator eikonal --json"
        ));
        report["paths"][0]["length"].as_f64().unwrap()
    };
    let straight = paths("uniform");
    for medium in [
        "vesselness",
        "vesselness --anisotropy 0.9 --scale 1.5,2.5",
        "vesselness --scale auto",
        "vesselness --polarity both --power 3 --floor 1e-5",
    ] {
        assert!(paths(medium) > 1.3 * straight, "{medium} cuts short");
    }
    // In the dark there is no tube, but along each side of the bright one.
    let bright = bench.json("medium line.npy --medium vesselness --json");
    let dark = bench.json("medium line.npy --medium vesselness --polarity dark --json");
    assert!(bright["mean"] != dark["mean"] && bright["max"].as_f64().unwrap() > 0.5);
}

#[test]
fn contrast_is_made_the_same_everywhere() {
    let bench = Bench::new();
    let line = |bright: fn(f64) -> f64, name: &str| {
        bench.write_npy(name, &[60, 120], |cell| {
            let (x, y) = ((cell % 120) as f64, (cell / 120) as f64);
            bright(x) * (-(y - 30.0).powi(2) / 8.0).exp() + 0.01 * (x + y).sin()
        });
    };
    line(|_| 1.0, "even.npy");
    line(|x| (-x / 50.0).exp(), "fading.npy");
    let faint = |file: &str, options: &str| {
        bench.json(&format!("medium {file} --medium vesselness {options} -o m.npy --force --json"));
        let values = bench.npy("m.npy").1;
        values[30 * 120 + 110] / values[30 * 120 + 10]
    };
    assert!(faint("fading.npy", "") < 0.1);
    assert!(faint("fading.npy", "--normalize 8") > 0.5);
    assert!(faint("fading.npy", "--normalize 8 --spacing 0.5,0.5") > 0.5);
    let physical = "--normalize 4 --scale 1,1.5,2.25 --physical --spacing 0.5,0.5";
    let (pixels, physical) = (faint("fading.npy", "--normalize 8"), faint("fading.npy", physical));
    assert!((pixels - physical).abs() < 1e-12);
    assert!((faint("even.npy", "--normalize 8") - 1.0).abs() < 0.1);
}

#[test]
fn long_tubes_leave_less_noise() {
    let bench = Bench::new();
    bench.write_npy("noisy.npy", &[80, 100], |cell| {
        let (x, y) = ((cell % 100) as f64, (cell / 100) as f64);
        let noise = (12.9898 * x + 78.233 * y).sin() * 43758.5453;
        (-(y - 40.0).powi(2) / 8.0).exp() + 0.8 * (noise - noise.floor())
    });
    // The mean on the line over what one in a hundred is above far from it.
    let contrast = |options: &str| {
        bench.json(&format!(
            "medium noisy.npy --medium vesselness {options} -o m.npy --force --json"
        ));
        let values = bench.npy("m.npy").1;
        let far = values.iter().enumerate().filter(|(cell, _)| (cell / 100).abs_diff(40) > 12);
        let mut far: Vec<f64> = far.map(|(_, value)| *value).collect();
        far.sort_by(f64::total_cmp);
        values[4000..4100].iter().sum::<f64>() / 100.0 / far[far.len() * 99 / 100]
    };
    let plain = contrast("");
    assert_eq!(contrast("--elongation 1"), plain);
    assert!(contrast("--elongation 3") > 1.5 * plain, "{} {plain}", contrast("--elongation 3"));
}

#[test]
fn scales_are_chosen_from_the_picture() {
    let bench = Bench::new();
    line(&bench);
    let medium = |options: &str| {
        bench.json(&format!("medium line.npy --medium vesselness {options} --json"))
    };
    let chosen = medium("--scale auto");
    let scales = chosen["scales"].as_array().unwrap();
    assert_eq!(scales.len(), 3);
    assert!(scales.iter().all(|scale| (1.0..4.0).contains(&scale.as_f64().unwrap())), "{chosen}");
    let text: Vec<String> = scales.iter().map(ToString::to_string).collect();
    let given = medium(&format!("--scale {}", text.join(",")));
    assert_eq!(given["mean"], chosen["mean"]);
    assert!(given["scales"].is_null());
    let physical = medium("--scale auto --physical --spacing 0.5,0.5");
    let ratio = physical["scales"][1].as_f64().unwrap() / scales[1].as_f64().unwrap();
    assert!((ratio - 0.5).abs() < 1e-12, "{physical}");
}

#[test]
fn heat_runs_along_directions() {
    let bench = Bench::new();
    line(&bench);
    for options in [
        "--tensor hessian --scale 2 --polarity bright",
        "--tensor structure --scale 1.5 --anisotropy 0.8",
        "--tensor gradient --anisotropy 0.5",
    ] {
        for solver in ["explicit --iterations 300", "implicit"] {
            let report = bench.json(&format!(
                "path line.npy --medium tensor {options} --solver {solver} --source 3,44.7 --end \
                 40,62 --json"
            ));
            assert_eq!(report["paths"][0]["ended"], "source", "{options} {solver}");
        }
    }
}

#[test]
fn the_heat_method_makes_maps_and_paths() {
    let bench = Bench::with_picture();
    let report = bench.json(
        "distance curve.png --medium uniform --estimator heat-method --source 50,40 -o d.npy --json",
    );
    assert_eq!(report["estimator"], "heat-method");
    let (_, values) = bench.npy("d.npy");
    for (cell, value) in values.iter().enumerate() {
        let exact = f64::hypot((cell % 100) as f64 - 50.0, (cell / 100) as f64 - 40.0);
        assert!((value - exact).abs() < 0.05, "{cell}: {value}, not {exact}");
    }
    let report =
        bench.json("path curve.png --estimator heat-method --source 50,40 --end 20,20 --json");
    assert_eq!(report["paths"][0]["ended"], "source");
}

#[test]
fn what_does_not_go_together_is_refused() {
    let bench = Bench::new();
    line(&bench);
    let heat_method = "distance line.npy --source 50,40 --estimator heat-method --json";
    bench.fails(&format!("{heat_method} --iterations 5"), 2, &["--iterations", "heat-method"]);
    bench.fails(&format!("{heat_method} --medium tensor"), 2, &["tensors"]);
    bench.fails(&format!("{heat_method} --time 0"), 2, &["time"]);
    let medium = "medium line.npy --json --medium";
    bench.fails(&format!("{medium} tensor --anisotropy 1"), 2, &["anisotropy", "0.9998"]);
    bench.fails(&format!("{medium} tensor --scale 1,2"), 2, &["--scale", "one number"]);
    bench.fails(&format!("{medium} vesselness --scale -1"), 2, &["-1"]);
    bench.fails(&format!("{medium} vesselness --scale auto,2"), 2, &["auto", "alone"]);
    bench.fails(&format!("{medium} tensor --scale auto"), 2, &["--scale", "one number"]);
    bench.write_npy("flat.npy", &[80, 100], |_| 0.5);
    let flat = "medium flat.npy --json --medium vesselness --scale auto";
    bench.fails(flat, 5, &["no tube", "--scale"]);
    bench.fails(&format!("{medium} vesselness --elongation 0.5"), 2, &["elongation", "1 to 10"]);
    bench.fails(&format!("{medium} uniform --normalize 0"), 2, &["sigma", "positive"]);
}
