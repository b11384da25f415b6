//! `plydrape limits`: the presets of limits and of the cell, each figure with its source.

use crate::failure::Done;
use crate::numbers::written;
use crate::results;
use plydrape::measure::Preset;
use plydrape::scene::CellPreset;
use plydrape_io::store::json;
use serde::Serialize;
use std::fmt::Write as _;
use std::process::ExitCode;

/// List the presets of `[limits]` and of `[cell]`, each figure with its source.
///
/// `preset = "NAME"` in the table `[limits]` or `[cell]` of a scene sets them; other keys of the scene override it.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Print one JSON object on standard output instead of a list.
    #[arg(long)]
    json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Printed {
    /// Presets of `[limits]`.
    limits: Vec<PrintedPreset>,
    /// Presets of `[cell]`.
    cell: Vec<PrintedPreset>,
}

/// A preset as `--json` prints it.
#[derive(Serialize)]
struct PrintedPreset {
    name: &'static str,
    about: &'static str,
    figures: Vec<PrintedFigure>,
}

/// A figure of a preset as `--json` prints it.
#[derive(Serialize)]
struct PrintedFigure {
    key: String,
    /// As a scene writes it.
    value: String,
    source: &'static str,
}

/// Widest line.
const WIDTH: usize = 99;

/// Prints the presets.
pub fn run(arguments: &Arguments) -> Done {
    let text = match arguments.json {
        true => json::to_text(&presets())?,
        false => text(),
    };
    results::print(&text, &[])?;
    Ok(ExitCode::SUCCESS)
}

/// All presets, their keys with their tables.
fn presets() -> Printed {
    let limits = Preset::ALL.iter().map(|preset| {
        let figures = preset.figures().iter().map(|figure| {
            let measure = figure.name.measure();
            PrintedFigure {
                key: format!("limits.{}", measure.name()),
                value: written(figure.value, measure.unit()),
                source: figure.source,
            }
        });
        PrintedPreset { name: preset.name(), about: preset.about(), figures: figures.collect() }
    });
    let cell = CellPreset::ALL.iter().map(|preset| {
        let figures = preset.figures().iter().map(|figure| PrintedFigure {
            key: figure.key.into(),
            value: figure.written.into(),
            source: figure.source,
        });
        PrintedPreset { name: preset.name(), about: preset.about(), figures: figures.collect() }
    });
    Printed { limits: limits.collect(), cell: cell.collect() }
}

fn text() -> String {
    let mut text = String::new();
    for preset in Preset::ALL {
        let _ = writeln!(text, "{}: {}", preset.name(), preset.about());
        for figure in preset.figures() {
            let measure = figure.name.measure();
            let value = written(figure.value, measure.unit());
            let _ = writeln!(text, "  {} = \"{value}\"", measure.name());
            text += &wrapped(figure.source, "    ");
        }
        text.push('\n');
    }
    for preset in CellPreset::ALL {
        let _ = writeln!(text, "cell {}: {}", preset.name(), preset.about());
        for figure in preset.figures() {
            let quote = if figure.written.contains(' ') { "\"" } else { "" };
            let _ = writeln!(text, "  {} = {quote}{}{quote}", figure.key, figure.written);
            text += &wrapped(figure.source, "    ");
        }
        text.push('\n');
    }
    text += &wrapped(
        "A preset is a set of numbers, no standard: a drape that keeps it has not been shown to keep one.",
        "",
    );
    text
}

/// Whole words in lines that are indented.
fn wrapped(text: &str, indent: &str) -> String {
    let mut out = String::new();
    let mut line = indent.to_string();
    for word in text.split_whitespace() {
        let full = line.chars().count() + 1 + word.chars().count() > WIDTH;
        if full && line.trim() != "" {
            let _ = writeln!(out, "{line}");
            line = indent.to_string();
        }
        if line.trim() != "" {
            line.push(' ');
        }
        line += word;
    }
    let _ = writeln!(out, "{line}");
    out
}
