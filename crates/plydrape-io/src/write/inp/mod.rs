//! An input deck for CalculiX and Abaqus: the ply as shells, the grippers' motion, gravity and the mold.
//!
//! [`text`] makes it from a result file alone, whose grippers are those of the model that decides. It is a second opinion: the shells know
//! nothing of what that model found of the ply. The parts:
//!
//! - `mesh`: the flat ply, with its corners and holes, in quadratic shells S8R with nodes at the grippers;
//! - `section`: one homogeneous layer with the ply's areal mass, bending rigidities and membrane stiffness;
//! - `pose`: where the flat ply starts; `motion`: from there through all steps of the result;
//! - `contact`: the mold as a rigid surface;
//! - `header`: what the deck carries and what not, in words and numbers, as comments.
//!
//! Every keyword is one that both programs know. Where they differ, the deck writes what both take: the mold is made of
//! S3 shells held in every node (CalculiX has no R3D3), the orthotropic stiffness is given as `ENGINEERING CONSTANTS`,
//! increments are controlled by `*CONTROLS` and not by `STABILIZE`. CalculiX makes a brick of 20 nodes of each shell.
//!
//! **Sag beside the model's.** The paper's ply, 4 × 2 grippers 98 mm apart on cells of 100 mm, sags by 9.2 mm at the mid
//! of its long edges where the catenary sags by 8.9 mm: the sheet hangs the inner part of its cells onto the middle of
//! the edge, which draws the parabola towards a V, √(50² − 49²) = 9.9 mm deep. The shear stiffness decides how much.

mod contact;
mod header;
mod mesh;
mod motion;
mod section;
mod text;

use crate::Error;
use crate::result::ResultFile;
use crate::write::pose::Pose;
use contact::RigidMold;
use mesh::Mesh;
use motion::{HANG, Tracks};
use plydrape::ply::Grid;
use section::{ShellSection, axes};
use text::{Deck, number};

/// The deck of a result, with the membrane stiffness per width `membrane` (N/m). Same result, same bytes.
///
/// # Errors
/// [`Error::NotPossible`] if the result has no steps or its grippers start on one line; a number that is not
/// finite is refused as in [`crate::store::json`].
pub fn text(result: &ResultFile, membrane: f64) -> Result<String, Error> {
    result.check_finite()?;
    let scene = &result.scene;

    // the flat ply begins at the rigid place that best fits the grippers of step 1
    let flat: Vec<[f64; 2]> = (0..scene.ply.grippers()).map(|n| scene.ply.place(n)).collect();
    let pose = Pose::start(result, &flat, |gripper| gripper.position)?;

    // shells and their section, the tracks of the grippers, and the mold below them
    let mesh = Mesh::new(&scene.ply);
    let section = ShellSection::new(scene, membrane);
    let tracks = Tracks::new(result, &pose);
    let weight = section.areal_mass * scene.settings.gravity;
    let mold = RigidMold::new(result, weight, section.thickness);

    // what holds in all steps: nodes, elements, material, contact and the tables of the motion
    let mut deck = Deck::default();
    header::write(result, &mesh, &section, mold.as_ref(), &mut deck);
    deck.line("*HEADING");
    deck.line("Ply between grippers, by plydrape");
    nodes(&mesh, &pose, mold.as_ref(), &mut deck);
    elements(&mesh, &mut deck);
    tracks.node_sets(&mesh, &mut deck);
    let printed = middles(result, &mesh, &mut deck);
    material(&section, scene.ply.warp, &pose, &mut deck);
    if let Some(mold) = &mold {
        mold.elements(mesh.nodes(), mesh.count(), &mut deck);
        mold.pair(&mut deck);
    }
    tracks.amplitudes(&mut deck);

    // step HANG: gravity grows, and the grippers go to step 1 of the result
    let gravity = format!("PLY, GRAV, {}, 0.0, 0.0, -1.0", number(scene.settings.gravity));
    step("HANG", HANG, 1e-4, &mut deck);
    deck.line("*DLOAD, AMPLITUDE=GRAVITY");
    deck.line(&gravity);
    tracks.boundary(&mut deck);
    output(&printed, &mut deck);

    // step LAY: the grippers follow the steps of the result
    if let Some(time) = tracks.lay_time() {
        step("LAY", time, 1e-2, &mut deck);
        output(&printed, &mut deck);
    }

    Ok(deck.text)
}

/// Nodes of the flat ply in its first place and, in the same block, which some readers ask for, of the mold.
fn nodes(mesh: &Mesh, pose: &Pose, mold: Option<&RigidMold>, deck: &mut Deck) {
    deck.line("*NODE");
    for (k, place) in mesh.places().enumerate() {
        deck.node(k + 1, pose.place(place));
    }
    if let Some(mold) = mold {
        mold.nodes(mesh.nodes(), deck);
    }
}

/// Elements of the ply.
fn elements(mesh: &Mesh, deck: &mut Deck) {
    deck.line("*ELEMENT, TYPE=S8R, ELSET=PLY");
    for (k, nodes) in mesh.elements().enumerate() {
        let mut ids = vec![k + 1];
        ids.extend(nodes);
        deck.list(&ids);
    }
}

/// The nodes in the middle between neighboring grippers of an array along u and along v, and the sets whose displacements are printed.
fn middles(result: &ResultFile, mesh: &Mesh, deck: &mut Deck) -> Vec<&'static str> {
    let ply = &result.scene.ply;
    let mut printed = vec!["GRIPPERS"];
    for (along, name) in ["MIDDLE_U", "MIDDLE_V"].into_iter().enumerate() {
        let ends = (0..ply.grippers()).filter_map(|n| {
            let mut next = ply.id(n);
            next[along] += 1;
            Some([n, ply.index(next).filter(|_| ply.grid != Grid::NONE)?].map(|n| ply.place(n)))
        });
        let nodes: Vec<usize> = ends.filter_map(|ends| mesh.middle(ends)).collect();
        if !nodes.is_empty() {
            deck.node_set(name, &nodes);
            printed.extend((along == 0).then_some(name));
        }
    }
    printed
}

/// Fiber directions, moduli, density and thickness.
fn material(section: &ShellSection, warp: plydrape::ply::Direction, pose: &Pose, deck: &mut Deck) {
    deck.line("*ORIENTATION, NAME=FIBERS, SYSTEM=RECTANGULAR");
    deck.numbers(axes(warp).into_iter().flat_map(|axis| pose.turn(axis)));
    deck.line("*MATERIAL, NAME=FABRIC");
    deck.line("*ELASTIC, TYPE=ENGINEERING CONSTANTS");
    let ([e1, e2, e3], [g12, g13, g23]) = (section.young(), section.shear_moduli());
    deck.numbers([e1, e2, e3, 0.0, 0.0, 0.0, g12, g13]);
    deck.numbers([g23]);
    deck.line("*DENSITY");
    deck.numbers([section.density()]);
    deck.line("*SHELL SECTION, ELSET=PLY, MATERIAL=FABRIC, ORIENTATION=FIBERS");
    deck.numbers([section.thickness]);
}

/// Opens a step of a given time (s) whose `first` increment is a share of it: increments may shrink to 10⁻⁷ of it and
/// take more iterations than usual, since a slack sheet is hard to bring to rest. A flat one has no stiffness against its
/// weight but its bending, so that hanging begins slowly.
fn step(name: &str, time: f64, first: f64, deck: &mut Deck) {
    deck.comment(name);
    deck.line("*STEP, NLGEOM, INC=10000");
    deck.line("*STATIC");
    deck.numbers([first, 1.0, 1e-7, 0.1].map(|share| share * time));
    deck.line("*CONTROLS, PARAMETERS=TIME INCREMENTATION");
    deck.line("10, 20, 9, 30, 10, 4, , 10");
    deck.line("0.25, 0.5, 0.75, 0.85, , , 1.5");
}

/// What is printed, and the end of the step.
fn output(printed: &[&str], deck: &mut Deck) {
    for set in printed {
        deck.line(&format!("*NODE PRINT, NSET={set}"));
        deck.line("U");
    }
    deck.line("*NODE PRINT, NSET=GRIPPERS, TOTALS=YES");
    deck.line("RF");
    deck.line("*NODE FILE");
    deck.line("U");
    deck.line("*END STEP");
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
