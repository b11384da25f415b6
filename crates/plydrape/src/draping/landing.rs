//! How far what has landed is from where the ideal drape has the same fabric, and how its fibres run.

use super::spans::Point;
use crate::mold::vector::{dot, sub, unit};
use crate::mold::{Strand, distance};
use crate::ply::{Kind, Laid};
use crate::scene::Scene;

/// A contact segment beside the ideal drape.
#[derive(Debug, Clone, PartialEq)]
pub struct Landing {
    /// Distance of each point of the segment from its ideal place (m), where that is known.
    pub errors: Vec<Option<f64>>,
    /// Largest angle between the segment and the ideal fibre (rad) and where it is; edges only.
    pub fibre_angle: Option<(f64, Point)>,
}

impl Landing {
    /// The largest distance (m) and the point of the segment that has it.
    #[must_use]
    pub fn worst(&self, line: &Strand) -> Option<(f64, Point)> {
        let known = self.errors.iter().zip(&line.points).filter_map(|(e, p)| e.map(|e| (e, *p)));
        known.max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// Fabric coordinates (u, v) (m) of a catenary at a share of its length from its first gripper.
fn fabric(scene: &Scene, catenary: usize, share: f64) -> [f64; 2] {
    let c = scene.ply.grid.catenary(catenary);
    let [a, b] = scene.ply.cell;
    let at = |from: usize, to: usize, side: f64| {
        side * (from as f64 + share * (to as f64 - from as f64))
    };
    [at(c.from[0], c.to[0], a), at(c.from[1], c.to[1], b)]
}

/// Lays a contact segment beside the ideal drape; none if that is not known.
pub fn landing(scene: &Scene, catenary: usize, laid: &Laid) -> Option<Landing> {
    let (mold, drape) = (scene.mold.as_ref()?, scene.target.as_ref()?.drape.as_ref()?);
    let line = &laid.line;
    let at = |arc: f64| fabric(scene, catenary, arc / laid.length);
    let place = |arc: f64| drape.place(mold, at(arc));
    let errors = line
        .arc
        .iter()
        .zip(&line.points)
        .map(|(arc, point)| place(*arc).map(|ideal| distance(*point, ideal)))
        .collect();
    let family = match scene.ply.grid.catenary(catenary).kind {
        Kind::EdgeU => Some(0),
        Kind::EdgeV => Some(1),
        Kind::Rising | Kind::Falling => None,
    };
    let angle = |n: usize| {
        let (from, to) = (line.points[n], line.points[n + 1]);
        let tangent = unit(sub(to, from))?;
        let fibres = drape.fibres(mold, at(0.5 * (line.arc[n] + line.arc[n + 1])))?;
        let fibre = fibres[family?];
        // chords of one curve: the sine is sharp where the cosine is flat
        let sine = crate::mold::vector::norm(crate::mold::vector::cross(tangent, fibre));
        Some((sine.atan2(dot(tangent, fibre)), from))
    };
    let pieces = 0..line.points.len().saturating_sub(1);
    let fibre_angle = pieces.filter_map(angle).max_by(|a, b| a.0.total_cmp(&b.0));
    Some(Landing { errors, fibre_angle })
}
