//! A step of a result file: a column for each quantity. What belongs to catenaries is there only where these draped.

use super::contact::{ContactColumns, Known};
use plydrape::draping::record::{
    Bridge, CatenaryState, CatenaryStep, Cell, Hold, Solver, SpanState,
};
use plydrape::measure::Measures;
use plydrape::outcome::{Gripper, Step};
use plydrape::ply::{Kind, Lines, Ply};
use serde::{Deserialize, Serialize};

/// The ply in one step.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StepColumns {
    step: usize,
    time: f64,
    measures: Measures,
    grippers: GripperColumns,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    solver: Option<Solver>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    slopes: Option<SlopeColumns>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    catenaries: Option<CatenaryColumns>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    spans: Option<SpanColumns>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    contact: Option<ContactColumns>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    bridging: Option<BridgeColumns>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    cells: Option<CellColumns>,
}

/// Grippers, i running fastest.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct GripperColumns {
    position: Vec<[f64; 3]>,
    /// Left out where all mounts are rigid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    commanded: Option<Vec<[f64; 3]>>,
    quaternion: Vec<[f64; 4]>,
    tilt_deg: Vec<f64>,
    #[serde(rename = "force_N")]
    force: Vec<[f64; 3]>,
    /// Left out where nothing slides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    slide_mm: Option<Vec<f64>>,
    /// Left out where all pads hold the ply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    holds: Option<Vec<bool>>,
    /// Left out where no gripper has a target.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    target_distance_mm: Option<Vec<f64>>,
}

/// Slopes of the ply at the grippers, null where no fiber line runs in that direction.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SlopeColumns {
    u: Vec<Option<f64>>,
    v: Vec<Option<f64>>,
}

/// Set lengths of all catenaries, and the diagonals that shear.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CatenaryColumns {
    length: Vec<f64>,
    shearing: Vec<usize>,
    /// One for each that shears.
    #[serde(rename = "shear_force_N")]
    shear_force: Vec<Option<f64>>,
}

/// Segments outside of contact, catenary by catenary.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SpanColumns {
    catenary: Vec<usize>,
    segment: Vec<usize>,
    hold: Vec<Hold>,
    length: Vec<f64>,
    path: Vec<f64>,
    #[serde(rename = "H_N")]
    force: Vec<Option<f64>>,
    slopes: Vec<[f64; 2]>,
    prescribed: Vec<[bool; 2]>,
}

/// Touches away from contact segments.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct BridgeColumns {
    catenary: Vec<usize>,
    place: Vec<[f64; 3]>,
    gap: Vec<f64>,
    width: Vec<f64>,
}

/// Cells, i running fastest.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CellColumns {
    shear_deg: Vec<f64>,
    shearing: Vec<Option<Kind>>,
    landed_deg: Vec<[Option<f64>; 2]>,
}

impl StepColumns {
    /// The columns of a step; contact as what is new since what is `known`.
    pub(super) fn new(step: &Step, known: &mut Known) -> Self {
        // what a step has whichever model drapes
        let mut columns = StepColumns {
            step: step.step,
            time: step.time,
            measures: step.measures.clone(),
            grippers: GripperColumns::new(&step.grippers),
            solver: None,
            slopes: None,
            catenaries: None,
            spans: None,
            contact: None,
            bridging: None,
            cells: None,
        };
        let Some(CatenaryStep { solver, slopes, catenaries, cells }) = &step.catenaries else {
            return columns;
        };

        // columns of all spans and bridges, each with the number of its catenary
        let shearing = || catenaries.iter().enumerate().filter(|(_, line)| line.shearing);
        let mut spans = SpanColumns::default();
        let mut bridging = BridgeColumns::default();
        for (n, line) in catenaries.iter().enumerate() {
            for span in &line.spans {
                spans.push(n, span);
            }
            if let Some(Bridge { place, gap, width }) = line.bridging {
                bridging.catenary.push(n);
                bridging.place.push(place);
                bridging.gap.push(gap);
                bridging.width.push(width);
            }
        }

        // what only catenaries have
        columns.solver = Some(solver.clone());
        columns.slopes = Some(SlopeColumns {
            u: slopes.iter().map(|slope| slope[0]).collect(),
            v: slopes.iter().map(|slope| slope[1]).collect(),
        });
        columns.catenaries = Some(CatenaryColumns {
            length: catenaries.iter().map(|line| line.length).collect(),
            shearing: shearing().map(|(n, _)| n).collect(),
            shear_force: shearing().map(|(_, line)| line.shear_force_n).collect(),
        });
        columns.spans = Some(spans);
        columns.contact = Some(ContactColumns::since(known, catenaries));
        columns.bridging = Some(bridging);
        columns.cells = Some(CellColumns {
            shear_deg: cells.iter().map(|cell| cell.shear_deg).collect(),
            shearing: cells.iter().map(|cell| cell.shearing).collect(),
            landed_deg: cells.iter().map(|cell| cell.landed_deg).collect(),
        });
        columns
    }

    /// The step again, or what is impossible in it.
    pub(super) fn step(self, ply: &Ply, known: &mut Known) -> Result<Step, String> {
        // a step has all the parts of catenaries or not one of them
        let StepColumns { step, time, measures, grippers, .. } = self;
        let parts = (
            self.solver,
            self.slopes,
            self.catenaries,
            self.spans,
            self.contact,
            self.bridging,
            self.cells,
        );
        let catenaries = match parts {
            (None, None, None, None, None, None, None) => None,
            (
                Some(solver),
                Some(slopes),
                Some(catenaries),
                Some(spans),
                Some(contact),
                Some(bridging),
                Some(cells),
            ) => {
                // the catenaries, and on each its spans and where it touches the mold
                let mut lines = catenaries.lines(&ply.lines())?;
                spans.fill(&mut lines)?;
                contact.fill(known, &mut lines)?;
                bridging.fill(&mut lines)?;
                Some(CatenaryStep {
                    solver,
                    slopes: slopes.list(ply)?,
                    catenaries: lines,
                    cells: cells.list(&ply.lines())?,
                })
            }
            _ => return Err("it has a part of what belongs to catenaries".into()),
        };
        Ok(Step { step, time, grippers: grippers.list(ply)?, measures, catenaries })
    }
}

impl GripperColumns {
    fn new(grippers: &[Gripper]) -> Self {
        let yields = grippers.iter().any(|g| g.commanded != g.position);
        let slides = grippers.iter().any(|g| g.slide_mm != 0.0);
        let released = grippers.iter().any(|g| !g.holds);
        GripperColumns {
            position: grippers.iter().map(|g| g.position).collect(),
            commanded: yields.then(|| grippers.iter().map(|g| g.commanded).collect()),
            quaternion: grippers.iter().map(|g| g.quaternion).collect(),
            tilt_deg: grippers.iter().map(|g| g.tilt_deg).collect(),
            force: grippers.iter().map(|g| g.force).collect(),
            slide_mm: slides.then(|| grippers.iter().map(|g| g.slide_mm).collect()),
            holds: released.then(|| grippers.iter().map(|g| g.holds).collect()),
            target_distance_mm: grippers.iter().map(|g| g.target_distance_mm).collect(),
        }
    }

    fn list(self, ply: &Ply) -> Result<Vec<Gripper>, String> {
        let GripperColumns { commanded, slide_mm, holds, target_distance_mm, .. } = &self;
        let count = ply.grippers();
        let found = [
            self.position.len(),
            self.quaternion.len(),
            self.tilt_deg.len(),
            self.force.len(),
            commanded.as_ref().map_or(count, Vec::len),
            slide_mm.as_ref().map_or(count, Vec::len),
            holds.as_ref().map_or(count, Vec::len),
            target_distance_mm.as_ref().map_or(count, Vec::len),
        ];
        alike("grippers", count, &found)?;
        let gripper = |n: usize| Gripper {
            id: ply.id(n),
            position: self.position[n],
            commanded: commanded.as_ref().map_or(self.position[n], |all| all[n]),
            quaternion: self.quaternion[n],
            tilt_deg: self.tilt_deg[n],
            force: self.force[n],
            slide_mm: slide_mm.as_ref().map_or(0.0, |all| all[n]),
            holds: holds.as_ref().is_none_or(|all| all[n]),
            target_distance_mm: target_distance_mm.as_ref().map(|all| all[n]),
        };
        Ok((0..count).map(gripper).collect())
    }
}

impl SlopeColumns {
    fn list(self, ply: &Ply) -> Result<Vec<[Option<f64>; 2]>, String> {
        alike("slopes at grippers", ply.grippers(), &[self.u.len(), self.v.len()])?;
        Ok(self.u.into_iter().zip(self.v).map(|(u, v)| [u, v]).collect())
    }
}

impl BridgeColumns {
    fn fill(self, lines: &mut [CatenaryState]) -> Result<(), String> {
        let BridgeColumns { catenary, place, gap, width } = self;
        alike("bridging", catenary.len(), &[place.len(), gap.len(), width.len()])?;
        for (k, n) in catenary.into_iter().enumerate() {
            let bridge = Bridge { place: place[k], gap: gap[k], width: width[k] };
            line(lines, n)?.bridging = Some(bridge);
        }
        Ok(())
    }
}

impl CatenaryColumns {
    fn lines(self, graph: &Lines) -> Result<Vec<CatenaryState>, String> {
        alike("catenaries", graph.catenaries(), &[self.length.len()])?;
        alike("shearing diagonals", self.shearing.len(), &[self.shear_force.len()])?;
        let state = |(n, length): (usize, &f64)| {
            let known = graph.catenary(n);
            CatenaryState {
                kind: known.kind,
                from: known.from,
                to: known.to,
                length: *length,
                shearing: false,
                shear_force_n: None,
                spans: Vec::with_capacity(2),
                contact: None,
                bridging: None,
            }
        };
        let mut lines: Vec<_> = self.length.iter().enumerate().map(state).collect();
        for (n, force) in self.shearing.into_iter().zip(self.shear_force) {
            let line = line(&mut lines, n)?;
            (line.shearing, line.shear_force_n) = (true, force);
        }
        Ok(lines)
    }
}

impl SpanColumns {
    fn push(&mut self, catenary: usize, span: &SpanState) {
        self.catenary.push(catenary);
        self.segment.push(span.segment);
        self.hold.push(span.hold);
        self.length.push(span.length);
        self.path.push(span.path);
        self.force.push(span.force);
        self.slopes.push(span.slopes);
        self.prescribed.push(span.prescribed);
    }

    fn fill(self, lines: &mut [CatenaryState]) -> Result<(), String> {
        // all columns have one entry for each span
        let found = [
            self.segment.len(),
            self.hold.len(),
            self.length.len(),
            self.path.len(),
            self.force.len(),
            self.slopes.len(),
            self.prescribed.len(),
        ];
        alike("spans", self.catenary.len(), &found)?;
        for (k, n) in self.catenary.into_iter().enumerate() {
            let span = SpanState {
                segment: self.segment[k],
                hold: self.hold[k],
                length: self.length[k],
                path: self.path[k],
                force: self.force[k],
                slopes: self.slopes[k],
                prescribed: self.prescribed[k],
            };
            // a catenary has two segments at most, the first one first
            let line = line(lines, n)?;
            let last = line.spans.last().map(|span| span.segment);
            if span.segment > 1 || last >= Some(span.segment) {
                return Err(format!("catenary {n} has no segment {}", span.segment));
            }
            line.spans.push(span);
        }
        Ok(())
    }
}

impl CellColumns {
    fn list(self, graph: &Lines) -> Result<Vec<Cell>, String> {
        alike(
            "cells",
            graph.cells().len(),
            &[self.shear_deg.len(), self.shearing.len(), self.landed_deg.len()],
        )?;
        let cell = |n: usize| Cell {
            cell: graph.cells()[n].id,
            shear_deg: self.shear_deg[n],
            shearing: self.shearing[n],
            landed_deg: self.landed_deg[n],
        };
        Ok((0..graph.cells().len()).map(cell).collect())
    }
}

/// A catenary by its number.
pub(super) fn line(lines: &mut [CatenaryState], n: usize) -> Result<&mut CatenaryState, String> {
    let count = lines.len();
    lines.get_mut(n).ok_or_else(|| format!("there is no catenary {n} of {count}"))
}

/// Refuses columns that are not as long as they should be.
pub(super) fn alike(what: &str, count: usize, found: &[usize]) -> Result<(), String> {
    match found.iter().find(|found| **found != count) {
        Some(found) => Err(format!("it has {found} {what}, not {count}")),
        None => Ok(()),
    }
}
