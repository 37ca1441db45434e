//! What a core could do, and what a solver step does with it; `studies/peak` runs all this and writes the page.
//!
//! ```text
//! magworm-peak core RUNS                     # rates of the core
//! magworm-peak count PRESET LATENCIES…       # operations of a step; chains at these latencies by kind [ns]
//! magworm-peak time PRESET RUNS              # time of a step and of its phases
//! magworm-peak kinds                         # of operations
//! ```
//!
//! Prints comma-separated values. An example of this package since the extension's own build of the simulator then
//! serves it as well.

mod core;
mod counting;
#[path = "../count/robots.rs"]
mod robots;
mod steps;
mod twin;

use counting::KINDS;
use magworm::Model;
use magworm::scene::Scene;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("peak: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[&str]) -> Result<(), String> {
    match arguments {
        ["core", runs] => core::measure(number(runs)?),
        ["count", preset, latencies @ ..] => {
            let found =
                latencies.iter().map(|text| number(text)).collect::<Result<Vec<f64>, _>>()?;
            let by_kind = found.try_into();
            let by_kind = by_kind.map_err(|_| format!("latencies: allowed: {}", KINDS.len()))?;
            steps::count(&model(preset)?, by_kind)?;
        }
        ["time", preset, runs] => steps::measure(&model(preset)?, number(runs)?)?,
        ["kinds"] => println!("{}", KINDS.join(",")),
        _ => return Err("allowed: core, count, time, kinds, as main.rs says".to_string()),
    }
    Ok(())
}

fn number<T: std::str::FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("{text:?} is no number"))
}

fn model(preset: &str) -> Result<Model, String> {
    let scene = Scene::preset(preset).map_err(|error| error.to_string())?;
    Model::compile(&scene).map_err(|error| error.to_string())
}
