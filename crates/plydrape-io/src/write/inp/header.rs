//! The deck's header: what it carries, what not, and every choice in numbers.

use super::contact::RigidMold;
use super::mesh::Mesh;
use super::motion::{HANG, LOAD};
use super::section::ShellSection;
use super::text::Deck;
use crate::result::ResultFile;
use plydrape::layup::Model;
use plydrape::ply::Direction;

/// Widest line of the header's text.
const WIDTH: usize = 96;

/// Writes the header.
pub(super) fn write(
    result: &ResultFile,
    mesh: &Mesh,
    section: &ShellSection,
    mold: Option<&RigidMold>,
    deck: &mut Deck,
) {
    // what the deck was made of, for which programs, and what it can show
    let scene = &result.scene;
    paragraph(deck, &format!("Ply between grippers: {}", scene.title));
    paragraph(deck, &format!("Written from the result file of {}.", result.program));
    paragraph(deck, "For CalculiX (ccx) and Abaqus/Standard. Units: m, kg, s, N, Pa. z is up.");

    paragraph(
        deck,
        "What it is for: how the ply hangs between its grippers (step HANG), by another program. Statics cannot lay a ply, which snaps from fold to fold (step LAY); `plydrape export --to ngsolve` can.",
    );

    // the ply: its shells and how they resist
    heading(deck, "What the deck carries");
    paragraph(
        deck,
        &format!(
            "Ply: {} shells S8R of {:.4} x {:.4} m at most, {}flat at the start, at the rigid place that best fits the grippers of step 1. Axis 1 of the material is the warp, along {} of the fabric.",
            mesh.count(),
            mesh.side[0],
            mesh.side[1],
            if scene.ply.cut.is_some() {
                "those of which half or more is ply, and those at a gripper; "
            } else {
                "between the grippers; "
            },
            if scene.ply.warp == Direction::U { "u" } else { "v" },
        ),
    );
    paragraph(
        deck,
        &format!(
            "Section: areal mass {:.6e} kg/m2, bending rigidity per width D1 = {:.6e} N m (warp), D2 = {:.6e} N m (weft), tension stiffness per width A = {:.6e} N/m (mean of warp and weft; --tension sets it), shear stiffness per width {:.6e} N/m per rad, Poisson's ratios 0.",
            section.areal_mass,
            section.rigidity[0],
            section.rigidity[1],
            section.membrane,
            section.shear,
        ),
    );
    let [first, second, _] = section.young();
    paragraph(
        deck,
        &format!(
            "Fabric bends more easily than a plate of its thickness. So thickness and moduli are effective ones, of the homogeneous shell with E h3/12 = D and E h = A: h = sqrt(12 D/A) = {:.6e} m, E1 = {first:.6e} Pa, E2 = {second:.6e} Pa, density = areal mass / h = {:.6e} kg/m3.",
            section.thickness,
            section.density(),
        ),
    );
    paragraph(
        deck,
        "A is far below that of a yarn, 1e6 N/m: with that, every turn within an iteration makes false tension, and step HANG stands still. With 2e4 N/m it is complete in some 30 increments.",
    );
    for line in &section.assumed {
        paragraph(deck, line);
    }

    // the grippers with their steps, and the mold
    let held = if mesh.strip { "the whole line across the strip" } else { "one node" };
    paragraph(
        deck,
        &format!(
            "Grippers: sets g2_0 and so on, {held} each, moved by tables, free to turn. Step HANG ({HANG} s): gravity grows for {LOAD} s, then they go from the flat ply to step 1 of the result; step LAY follows the result's steps in its own time, {HANG} s later."
        ),
    );
    match mold {
        Some(mold) => paragraph(
            deck,
            &format!(
                "Mold: {} triangles around the grippers' motion, held in every node; contact without friction. In Abaqus a *RIGID BODY of the set MOLD does the same faster.",
                mold.triangles()
            ),
        ),
        None if scene.mold.is_some() => {
            paragraph(deck, "Mold: nothing of it lies below the grippers; there is no contact.");
        }
        None => {}
    }

    // what the model of the result has and the deck leaves out
    heading(deck, "What the deck does not carry");
    let [ply, touch] = match result.model() {
        Model::Catenaries => [
            "The model's catenaries: here the ply is a sheet. It shears with the stiffness above, at any angle; locking and the model's shearing diagonals are not in it.",
            "The model's infinite friction, its contact segments and its rule of laying without stretch. Add *FRICTION to the interaction TOUCH for friction.",
        ],
        Model::Sheet => [
            "The curves of the model's sheet: the ply shears and stretches with the stiffnesses above, at any angle and strain; locking is not in it.",
            "The model's friction and tack. Add *FRICTION to the interaction TOUCH for friction.",
        ],
    };
    paragraph(deck, ply);
    if mold.is_some() {
        paragraph(deck, touch);
    }
    paragraph(
        deck,
        "The grippers' size, mass and tilt limit, their mounts, and pads that let go: a gripper is a point (of a strip, a line).",
    );

    // these only where the scene has them
    if scene.ply.cut.is_none() && scene.settings.sheet.overhang > 0.0 {
        paragraph(deck, "The fabric beyond the grippers of the array.");
    }
    if scene.tool.as_ref().is_some_and(|tool| tool.fixed_pads.is_some()) {
        paragraph(deck, "Pads without joints, which hold the ply in the direction of the tool.");
    }
    paragraph(deck, "Damping, rate effects, plastic bending, tack, prepreg cure.");
    paragraph(
        deck,
        "If LAY stops early: smaller increments, *DYNAMIC instead of *STATIC, or in Abaqus *STATIC, STABILIZE (which CalculiX does not know). A static sheet that wrinkles may jump.",
    );
}

/// A line that opens a part of the header.
fn heading(deck: &mut Deck, text: &str) {
    deck.comment("");
    deck.comment(&format!("{text}:"));
}

/// A comment broken at spaces.
fn paragraph(deck: &mut Deck, text: &str) {
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() && line.len() + word.len() >= WIDTH {
            deck.comment(&line);
            line.clear();
            line.push(' ');
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    deck.comment(&line);
}
