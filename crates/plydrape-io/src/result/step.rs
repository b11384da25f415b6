//! A step as it stands in a result file: a column for each quantity.

use super::contact::{ContactColumns, Known};
use plydrape::draping::record::{
    Bridge, CatenaryState, Cell, Gripper, Hold, Measures, Mount, Solver, SpanState, Step,
};
use plydrape::ply::{Kind, Lines, Ply};
use serde::{Deserialize, Serialize};

/// The ply in one step.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StepColumns {
    step: usize,
    time: f64,
    solver: Solver,
    measures: Measures,
    grippers: GripperColumns,
    catenaries: CatenaryColumns,
    spans: SpanColumns,
    contact: ContactColumns,
    bridging: BridgeColumns,
    cells: CellColumns,
}

/// Grippers, i running fastest.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct GripperColumns {
    position: Vec<[f64; 3]>,
    slope_u: Vec<Option<f64>>,
    slope_v: Vec<Option<f64>>,
    tilt_deg: Vec<f64>,
    quaternion: Vec<[f64; 4]>,
    /// None where no gripper has a target.
    target_distance_mm: Option<Vec<f64>>,
    /// Left out where all mounts are rigid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    mounts: Option<MountColumns>,
}

/// The mounts of the grippers.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct MountColumns {
    commanded: Vec<[f64; 3]>,
    #[serde(rename = "force_N")]
    force: Vec<[f64; 3]>,
    slip: Vec<[f64; 2]>,
    on_mold: Vec<bool>,
}

impl MountColumns {
    /// Those of grippers that all have one.
    fn of(grippers: &[Gripper]) -> Option<MountColumns> {
        let mounts: Vec<Mount> = grippers.iter().map(|g| g.mount).collect::<Option<_>>()?;
        (!mounts.is_empty()).then(|| MountColumns {
            commanded: mounts.iter().map(|m| m.commanded).collect(),
            force: mounts.iter().map(|m| m.force).collect(),
            slip: mounts.iter().map(|m| m.slip).collect(),
            on_mold: mounts.iter().map(|m| m.on_mold).collect(),
        })
    }

    fn mount(&self, n: usize) -> Mount {
        Mount {
            commanded: self.commanded[n],
            force: self.force[n],
            slip: self.slip[n],
            on_mold: self.on_mold[n],
        }
    }
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
    pub(super) fn of(step: &Step, known: &mut Known) -> Self {
        let shearing = || step.catenaries.iter().enumerate().filter(|(_, line)| line.shearing);
        let mut spans = SpanColumns::default();
        let mut bridging = BridgeColumns::default();
        for (n, line) in step.catenaries.iter().enumerate() {
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
        let grippers = &step.grippers;
        let target: Option<Vec<f64>> = grippers.iter().map(|g| g.target_distance_mm).collect();
        StepColumns {
            step: step.step,
            time: step.time,
            solver: step.solver.clone(),
            measures: step.measures.clone(),
            grippers: GripperColumns {
                position: grippers.iter().map(|g| g.position).collect(),
                slope_u: grippers.iter().map(|g| g.slope_u).collect(),
                slope_v: grippers.iter().map(|g| g.slope_v).collect(),
                tilt_deg: grippers.iter().map(|g| g.tilt_deg).collect(),
                quaternion: grippers.iter().map(|g| g.quaternion).collect(),
                target_distance_mm: target,
                mounts: MountColumns::of(grippers),
            },
            catenaries: CatenaryColumns {
                length: step.catenaries.iter().map(|line| line.length).collect(),
                shearing: shearing().map(|(n, _)| n).collect(),
                shear_force: shearing().map(|(_, line)| line.shear_force_n).collect(),
            },
            spans,
            contact: ContactColumns::since(known, &step.catenaries),
            bridging,
            cells: CellColumns {
                shear_deg: step.cells.iter().map(|cell| cell.shear_deg).collect(),
                shearing: step.cells.iter().map(|cell| cell.shearing).collect(),
                landed_deg: step.cells.iter().map(|cell| cell.landed_deg).collect(),
            },
        }
    }

    /// The step again, or what is impossible in it.
    pub(super) fn step(self, ply: &Ply, known: &mut Known) -> Result<Step, String> {
        let mut catenaries = self.catenaries.lines(&ply.lines())?;
        self.spans.fill(&mut catenaries)?;
        self.contact.fill(known, &mut catenaries)?;
        let BridgeColumns { catenary, place, gap, width } = self.bridging;
        alike("bridging", catenary.len(), &[place.len(), gap.len(), width.len()])?;
        for (k, n) in catenary.into_iter().enumerate() {
            let bridge = Bridge { place: place[k], gap: gap[k], width: width[k] };
            line(&mut catenaries, n)?.bridging = Some(bridge);
        }
        Ok(Step {
            step: self.step,
            time: self.time,
            grippers: self.grippers.list(ply)?,
            solver: self.solver,
            catenaries,
            cells: self.cells.list(&ply.lines())?,
            measures: self.measures,
        })
    }
}

impl GripperColumns {
    fn list(self, ply: &Ply) -> Result<Vec<Gripper>, String> {
        let targets = self.target_distance_mm.as_ref();
        let found = [
            self.position.len(),
            self.slope_u.len(),
            self.slope_v.len(),
            self.tilt_deg.len(),
            self.quaternion.len(),
            targets.map_or(ply.grippers(), Vec::len),
        ];
        alike("grippers", ply.grippers(), &found)?;
        if let Some(MountColumns { commanded, force, slip, on_mold }) = &self.mounts {
            let found = [commanded.len(), force.len(), slip.len(), on_mold.len()];
            alike("mounts", ply.grippers(), &found)?;
        }
        let gripper = |n: usize| Gripper {
            id: ply.id(n),
            position: self.position[n],
            slope_u: self.slope_u[n],
            slope_v: self.slope_v[n],
            tilt_deg: self.tilt_deg[n],
            quaternion: self.quaternion[n],
            target_distance_mm: targets.map(|targets| targets[n]),
            mount: self.mounts.as_ref().map(|mounts| mounts.mount(n)),
        };
        Ok((0..ply.grippers()).map(gripper).collect())
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
