//! Scenes that benchmarks drape and plan.

use plydrape::scene::Scene;
use plydrape_io::scene;
use std::path::{Path, PathBuf};

/// The folder of the examples.
pub fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

/// The scene of an example in its folder.
pub fn example(folder: &Path) -> Scene {
    let text = std::fs::read_to_string(folder.join("scene.toml")).expect("a shipped scene");
    read(&text, folder)
}

/// A ply of a material, by its line in the scene, on grippers in cells of 100 mm over a mold, by its lines.
pub fn array([nu, nv]: [usize; 2], material: &str, mold: &str, folder: &Path) -> Scene {
    let text = format!(
        "[ply]\ngrippers = [{nu}, {nv}]\ncell = [0.1, 0.1]\n{material}\n[mold]\n{mold}\n\
         [grippers]\nspacing = [0.098, 0.098]\nheight = 0.1\norigin = \"centered\"\n\
         [target]\nseed = \"middle\"\n"
    );
    read(&text, folder)
}

/// The lines of a dome of a radius (m) whose top is the origin.
pub fn dome(radius: f64) -> String {
    format!("kind = \"sphere\"\nradius = {radius}\nposition = [0, 0, -{radius}]")
}

/// Whether a row is asked for: its name holds one of the words behind the command, or there are none.
pub fn is_asked(name: &str) -> bool {
    let mut words = std::env::args().skip(1).filter(|word| !word.starts_with("--")).peekable();
    words.peek().is_none() || words.any(|word| name.contains(&word))
}

fn read(text: &str, folder: &Path) -> Scene {
    scene::parse(text, folder, "scene.toml").unwrap_or_else(|error| panic!("{error}")).scene
}
