//! What a scene must have to be draped as a sheet.

use super::file::SceneKeys;
use super::source::Document;
use crate::Error;
use crate::store::shown::{listed, millimeters};
use crate::store::size::{self, PlanSheets};
use plydrape::layup::Settings;
use plydrape::material::{Material, Section};
use plydrape::planner::tuning::TUNING;
use plydrape::ply::Ply;
use plydrape::sheet::{coarsest_mesh, pitch};
use std::ops::Range;

/// Lines of nodes across the shorter side of a cell, unless the scene gives their distance.
const LINES: f64 = 10.0;

/// Refuses a sheet if material, pads, mesh or memory do not allow it; `otherwise` says how to do without. Returns the sheets of a plan.
pub(super) fn fits(
    file: &SceneKeys,
    ply: &Ply,
    settings: &Settings,
    steps: usize,
    otherwise: &str,
    document: &Document,
) -> Result<PlanSheets, Error> {
    stiffness(&file.ply.value.material.span, &ply.material, otherwise, document)?;
    let around = Around { file, ply, settings, document };
    around.pads()?;
    let mesh = around.mesh()?;
    // and the one after a release
    let states = settings.sheet.keep.min(steps) + usize::from(file.release.is_some());
    let nodes = around.nodes(mesh);
    size::sheet(nodes, states).map_err(|fault| {
        let span = around.mesh_span().unwrap_or_else(|| file.grippers_span().clone());
        document.error(
            span,
            fault.to_string(),
            format!("{}; a coarser `mesh` has fewer nodes", fault.help()),
        )
    })?;
    let coarse = mesh.max(TUNING.mesh * pitch(ply));
    Ok(PlanSheets { nodes, coarse_nodes: around.nodes(coarse), keep: settings.sheet.keep })
}

/// Refuses a material that does not say how it resists tension, shear and bending; `span` is where the scene names it.
fn stiffness(
    span: &Range<usize>,
    material: &Material,
    otherwise: &str,
    document: &Document,
) -> Result<(), Error> {
    // whether the material resists bending, and which keys say so
    let rigid = match material.section {
        Section::Line { flexural_rigidity, .. } => flexural_rigidity > 0.0,
        Section::Areal { warp_rigidity, weft_rigidity, .. } => {
            warp_rigidity > 0.0 && weft_rigidity > 0.0
        }
    };
    let bending = match material.section {
        Section::Line { .. } => "`flexural_rigidity`",
        Section::Areal { .. } => "`bending_rigidity_warp` and `_weft`",
    };

    // each stiffness that the sheet needs, with its key and the test that measures it
    let tests = [
        (material.tension.is_some(), "tension", "`tension`", "a tensile test"),
        (
            material.shear_curve.is_some(),
            "shear",
            "`shear_curve`",
            "a picture-frame or a bias-extension test",
        ),
        (rigid, "bending", bending, "a cantilever test (ASTM D1388)"),
    ];

    // all that is missing is named at once
    let missing: Vec<_> = tests.iter().filter(|(known, ..)| !known).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let kinds: Vec<&str> = missing.iter().map(|(_, kind, ..)| *kind).collect();
    let remedies: Vec<String> =
        missing.iter().map(|(.., key, test)| format!("{key} from {test}")).collect();
    Err(document.error(
        span.clone(),
        format!(
            "the material {} has no stiffness in {}, which the sheet needs",
            material.name,
            listed(&kinds)
        ),
        format!("give the material its {}; or {otherwise}", remedies.join(", and its ")),
    ))
}

/// What the pads and the mesh of a sheet are held against.
struct Around<'a> {
    file: &'a SceneKeys,
    ply: &'a Ply,
    settings: &'a Settings,
    document: &'a Document,
}

impl Around<'_> {
    /// Refuses pads and lips that overlap, and pads that hang over the boundary.
    fn pads(&self) -> Result<(), Error> {
        let radius = self.settings.pad.radius;
        let (pitch, overhang) = (pitch(self.ply), self.settings.sheet.overhang);
        let overlap = |what: &str, radius: f64, help: &str, span: Range<usize>| {
            let [width, apart, most] = [2.0 * radius, pitch, 0.5 * pitch].map(millimeters);
            self.document.error(
                span,
                format!("the {what} overlap: they are {width} mm wide and {apart} mm apart"),
                format!("a radius below {most} mm leaves fabric between them{help}"),
            )
        };
        if let Some(lip) = self.settings.pad.lip.filter(|lip| 2.0 * lip.radius >= pitch) {
            let help = match self.lip_span() {
                Some(_) => String::new(),
                None => format!(
                    "; write lip = {{ radius = \"{} mm\" }} in [grippers], where that of the cell is in force now",
                    millimeters(0.4 * pitch)
                ),
            };
            let span = self.lip_span().unwrap_or_else(|| self.file.grippers_span().clone());
            return Err(overlap("lips", lip.radius, &help, span));
        }
        let Some(span) = self.pad_span().filter(|_| radius > 0.0) else { return Ok(()) };
        if 2.0 * radius >= pitch {
            return Err(overlap("pads", radius, "", span));
        }
        // cups of a ply that is cut are on it, or hold nothing
        if self.ply.cut.is_none() && radius > overhang * (1.0 + ROUNDING) {
            return Err(self.document.error(
                span,
                format!(
                    "the outermost pads hang over the boundary: their radius is {} mm, and there are {} mm of fabric beyond the grippers",
                    millimeters(radius),
                    millimeters(overhang)
                ),
                format!("give overhang = \"{} mm\" or more in [ply], or smaller pads", millimeters(radius)),
            ));
        }
        Ok(())
    }

    /// The largest distance between lines of nodes (m); refuses one that leaves no line between two pads.
    fn mesh(&self) -> Result<f64, Error> {
        // as fine as the scene says, or else by a fixed number of lines across a cell
        let mesh = self.settings.sheet.mesh.unwrap_or(pitch(self.ply) / LINES);
        let most = coarsest_mesh(pitch(self.ply), self.settings.pad.radius);
        if mesh <= most * (1.0 + ROUNDING) {
            return Ok(mesh);
        }

        // a mesh that is given is too coarse; without one it is the pads that are too large
        let between = format!("{} mm of fabric between neighboring pads", millimeters(2.0 * most));
        let Some(span) = self.mesh_span() else {
            let span = self.pad_span().unwrap_or_else(|| self.file.grippers_span().clone());
            return Err(self.document.error(
                span,
                format!(
                    "there are {between}, less than two lines of nodes {} mm apart need",
                    millimeters(mesh)
                ),
                format!(
                    "give mesh = \"{} mm\" or less in [sheet], or smaller pads",
                    millimeters(most)
                ),
            ));
        };
        Err(self.document.error(
            span,
            format!(
                "lines of nodes {} mm apart meet neither pads nor boundary: there are {between}",
                millimeters(mesh)
            ),
            format!("{} mm or less puts a line between them", millimeters(most)),
        ))
    }

    /// How many nodes a mesh has: its lines meet boundary, pads and grippers; one row of grippers is on a single line.
    fn nodes(&self, mesh: f64) -> f64 {
        let radius = self.settings.pad.radius;
        if self.ply.cut.is_some() {
            let [low, high] = self.ply.bounds(0.0);
            let grippers = 3.0 * (self.ply.grippers() as f64).sqrt();
            return [0, 1].map(|n| (high[n] - low[n]) / mesh + grippers).iter().product();
        }
        let lines = |length: f64| {
            if length > 0.0 { (length / mesh * (1.0 - ROUNDING)).ceil() } else { 0.0 }
        };
        let along = |count: usize, side: f64| {
            if count == 1 {
                return 1.0;
            }
            let between = lines(side - 2.0 * radius) + 2.0 * lines(radius);
            let beyond = lines(self.settings.sheet.overhang - radius) + lines(radius);
            (count as f64 - 1.0) * between + 2.0 * beyond + 1.0
        };
        let (grid, [a, b]) = (self.ply.grid, self.ply.cell);
        along(grid.nu, a) * along(grid.nv, b)
    }

    fn lip_span(&self) -> Option<Range<usize>> {
        Some(self.file.grippers.as_ref()?.value.lip.as_ref()?.span.clone())
    }

    fn mesh_span(&self) -> Option<Range<usize>> {
        Some(self.file.sheet.mesh.as_ref()?.span.clone())
    }

    fn pad_span(&self) -> Option<Range<usize>> {
        Some(self.file.grippers.as_ref()?.value.pad_radius.as_ref()?.span.clone())
    }
}

/// Rounding of lengths that come from decimal numbers, as a share of them.
const ROUNDING: f64 = 1e-9;
