//! The mold as a rigid surface of triangles, and its contact with the ply.
//!
//! It is rigid because every node of it is held. (CalculiX knows no R3D3, and its `*RIGID BODY` ends in a crash on some
//! thousand shells.) The mold is taken over the rectangle in which the grippers move and half a cell around it. Contact is without friction
//! and, as a penalty, linear: the ply lying on the mold under its own weight is pressed in by a tenth of the model's
//! contact tolerance.

use super::text::{Deck, number};
use crate::result::ResultFile;
use crate::write::mold_patch::extent;
use plydrape::mold::patch::{Triangles, patch};

/// Most triangles of the mold.
const TRIANGLES: usize = 2000;

/// A mold for a deck.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RigidMold {
    surface: Triangles,
    /// Thickness (m) of its shells, half of which stands out of the surface.
    thickness: f64,
    /// Pressure per depth (Pa/m).
    stiffness: f64,
}

impl RigidMold {
    /// The mold of a result under its motion, if there is one. `weight` is that of the ply per area (Pa), `thickness`
    /// that of its shells (m).
    pub fn new(result: &ResultFile, weight: f64, thickness: f64) -> Option<RigidMold> {
        let mold = result.scene.mold.as_ref()?;
        let margin = 0.5 * result.scene.ply.cell[0].max(result.scene.ply.cell[1]);
        let [low, high] = extent(result)?;
        let surface = patch(mold, low.map(|c| c - margin), high.map(|c| c + margin), TRIANGLES);
        let depth = 0.1 * result.scene.settings.contact.tolerance;
        let stiffness = weight / depth;
        (!surface.triangles.is_empty()).then_some(RigidMold { surface, thickness, stiffness })
    }

    /// Number of triangles.
    pub fn triangles(&self) -> usize {
        self.surface.triangles.len()
    }

    /// Node lines, numbered on from the ply's.
    pub fn nodes(&self, nodes: usize, deck: &mut Deck) {
        for (k, vertex) in self.surface.vertices.iter().enumerate() {
            deck.node(nodes + 1 + k, *vertex);
        }
    }

    /// Elements, numbered on from those of the ply, and what makes them rigid: every node is held.
    pub fn elements(&self, nodes: usize, elements: usize, deck: &mut Deck) {
        deck.line("*ELEMENT, TYPE=S3, ELSET=MOLD");
        for (k, corners) in self.surface.triangles.iter().enumerate() {
            let [a, b, c] = corners.map(|n| nodes + 1 + n as usize);
            deck.list(&[elements + 1 + k, a, b, c]);
        }
        let all: Vec<usize> = (1..=self.surface.vertices.len()).map(|k| nodes + k).collect();
        deck.node_set("MOLD_NODES", &all);
        deck.line("*MATERIAL, NAME=RIGID");
        deck.line("*ELASTIC");
        deck.line("2.1e11, 0.3");
        deck.line("*DENSITY");
        deck.line("7850.0");
        deck.line("*SHELL SECTION, ELSET=MOLD, MATERIAL=RIGID");
        deck.line(&number(self.thickness));
        deck.line("*BOUNDARY");
        deck.line("MOLD_NODES, 1, 3");
    }

    /// Surfaces, their interaction and the pair: the ply's lower side is the slave of the mold's upper one.
    pub fn pair(&self, deck: &mut Deck) {
        deck.line("*SURFACE, NAME=PLY_LOWER, TYPE=ELEMENT");
        deck.line("PLY, SNEG");
        deck.line("*SURFACE, NAME=MOLD_UPPER, TYPE=ELEMENT");
        deck.line("MOLD, SPOS");
        deck.line("*SURFACE INTERACTION, NAME=TOUCH");
        deck.line("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR");
        deck.line(&number(self.stiffness));
        deck.line("*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE");
        deck.line("PLY_LOWER, MOLD_UPPER");
    }
}
