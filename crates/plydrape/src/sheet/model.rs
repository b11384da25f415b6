//! The sheet of a layup: its fabric, laws and grippers, checked.

use super::fabric::{Fabric, lines};
use super::gripper::Gripper;
use super::lip::Under;
use crate::Error;
use crate::layup::{Friction, Layup, PadSettings, Settings, SheetTime};
use crate::material::{MomentCurve, Section, ShearCurve, ShearRate, TensionLaw};
use crate::mold::Mold;
use crate::ply::{Direction, Grid, Neighbors, Outline, Ply};
use crate::tool::Tool;

/// Share of a cell that must be ply for the cell to count. Less of it is a sliver of fabric whose nodes hardly have a mass:
/// with a mesh of 10 mm the boundary is half a millimeter off at most where slivers are left out.
const LEAST_SHARE: f64 = 0.05;
/// Height of pads over a table, as a share of the pitch, at which they are on the ply that lies there.
const ON_TABLE: f64 = 0.01;
/// Distance of two lines, as a share of the mesh, below which the less important one is not met.
const CLOSE: f64 = 0.3;

/// A ply as a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Nodes, segments and cells.
    pub fabric: Fabric,
    /// Grippers.
    pub grippers: Vec<Gripper>,
    /// The mold; `None` for a ply that only hangs.
    pub mold: Option<Mold>,
    /// Mass per area (kg/m²).
    pub areal_mass: f64,
    /// Flexural rigidity per width D′ along u and v (N·m).
    pub rigidity: [f64; 2],
    /// Bending moment per width over the curvature along u and v, where it is not D′ κ.
    pub moment: [Option<MomentCurve>; 2],
    /// Tension per width of the yarns.
    pub tension: TensionLaw,
    /// Shear force per length of the cells.
    pub shear: ShearCurve,
    /// What resin adds to it while the ply is sheared; `None` of a ply that is draped quasi-statically, whose time is no real one.
    pub shear_rate: Option<ShearRate>,
    /// Acceleration of gravity g (m/s²).
    pub gravity: f64,
    /// What holds it along the mold.
    pub friction: Friction,
    /// Shear stress of its tack τ₀ (Pa).
    pub tack: f64,
    /// Shortest distance between neighboring grippers in the fabric (m), the length that tolerances scale with.
    pub pitch: f64,
    /// Largest distance of neighboring lines (m).
    pub mesh: f64,
    /// What carries the grippers, if they do not move by themselves.
    pub tool: Option<Tool>,
    /// Height of the table on which the ply lies as the motion begins z (m); `None` of a ply that begins in the air.
    pub table: Option<f64>,
}

impl Sheet {
    /// The sheet of a layup.
    ///
    /// # Errors
    /// [`Error::SheetNoShear`], [`Error::SheetNoTension`], [`Error::SheetTensionTable`] or [`Error::SheetMomentTable`] for the material;
    /// [`Error::SheetCoarse`] for the mesh; [`Error::SheetPadsOverlap`], [`Error::SheetPadsOverhang`], [`Error::SheetPadOff`],
    /// [`Error::SheetPadSmall`] or [`Error::SheetPadPoint`] for pads; [`Error::SheetRange`] for a number.
    pub fn new(layup: &Layup) -> Result<Self, Error> {
        let (ply, settings) = (&layup.ply, &layup.settings);
        let material = &ply.material;
        let name = || material.name.clone();
        let shear =
            material.shear_curve.clone().ok_or_else(|| Error::SheetNoShear { material: name() })?;
        let tension =
            material.tension.clone().ok_or_else(|| Error::SheetNoTension { material: name() })?;

        if let TensionLaw::Table { strain, force } = &tension {
            let ascends = |x: &[f64], strictly: bool| {
                x.first() == Some(&0.0)
                    && x.iter().all(|x| x.is_finite())
                    && x.windows(2).all(|pair| pair[1] > pair[0] || !strictly && pair[1] == pair[0])
            };
            let table = ascends(strain, true) && ascends(force, false);
            if !table || strain.len() != force.len() || strain.len() < 2 {
                return Err(Error::SheetTensionTable { material: name() });
            }
        }

        if !material.moment.iter().flatten().all(MomentCurve::is_sound) {
            return Err(Error::SheetMomentTable { material: name() });
        }

        let [a, b] = ply.cell;
        let pitch = pitch(ply);
        let mesh = settings.sheet.mesh.unwrap_or(0.1 * pitch);
        let (radius, overhang) = (settings.pad.radius, settings.sheet.overhang);
        let positive = |what, value: f64| check(value > 0.0, what, value, "positive");
        let not_negative = |what, value: f64| check(value >= 0.0, what, value, "zero or more");
        positive("the mesh", mesh)?;
        not_negative("the pad radius", radius)?;
        not_negative("the overhang", overhang)?;
        positive("the length factor of the ply", ply.length_factor)?;
        not_negative("the tack", settings.contact.tack)?;
        if let Friction::Coulomb(mu) = settings.contact.friction {
            not_negative("the friction", mu)?;
        }
        let mount = [settings.pad.lateral_stiffness, settings.pad.axial_stiffness];
        for stiffness in mount.into_iter().flatten() {
            positive("the stiffness of the mounts", stiffness)?;
        }
        if let Some(lip) = &settings.pad.lip {
            positive("the radius of the lips", lip.radius)?;
            positive("the rigidity of the lips", lip.rigidity)?;
        }
        let widest = settings.pad.lip.map_or(radius, |lip| radius.max(lip.radius));
        if 2.0 * widest >= pitch {
            return Err(Error::SheetPadsOverlap { radius_mm: widest * 1e3, pitch_mm: pitch * 1e3 });
        }
        let most = coarsest_mesh(pitch, radius);
        if mesh > most * (1.0 + 1e-9) {
            let [mesh_mm, between_mm, most_mm] = [mesh, 2.0 * most, most].map(|x| x * 1e3);
            return Err(Error::SheetCoarse { mesh_mm, between_mm, most_mm });
        }
        // a single line stands for a strip one cell wide
        let width = if b > 0.0 { b } else { a };
        let fabric = Fabric::new(ply, settings)?;

        let areal_mass = ply.areal_mass();
        let rigidity = match material.section {
            // a line is a strip one cell wide
            Section::Line { flexural_rigidity, .. } => {
                [flexural_rigidity / width, flexural_rigidity / a]
            }
            Section::Areal { warp_rigidity, weft_rigidity, .. } => match ply.warp {
                Direction::U => [warp_rigidity, weft_rigidity],
                Direction::V => [weft_rigidity, warp_rigidity],
            },
        };
        let [warp, weft] = material.moment.clone();
        let moment = match ply.warp {
            Direction::U => [warp, weft],
            Direction::V => [weft, warp],
        };
        positive("the areal mass", areal_mass)?;
        positive("the gravity", settings.gravity)?;
        for rigidity in rigidity {
            not_negative("the bending rigidity", rigidity)?;
        }
        let is_real = settings.sheet.time == SheetTime::Real;
        let shear_rate = material.shear_rate.clone().filter(|_| is_real);
        if let Some(rate) = &shear_rate {
            not_negative("the stiffness of fast shear", rate.stiffness)?;
            positive("the relaxation time of shear", rate.time())?;
        }
        let mount = mount_stiffness(&settings.pad, 1e3 * tension.tension(0.0)[2], pitch);
        let gripper = |n: usize| {
            let place = ply.place(n);
            let mut lip = match &settings.pad.lip {
                Some(lip) => Under::new(&fabric, lip, place),
                None => Under::default(),
            };
            // a rigid gripper holds a point, and a disc all of its nodes
            if mount.is_none() || radius > 0.0 {
                lip.nodes.clear();
            }
            let (slip_force, max_tilt) = (settings.pad.slip_force, settings.max_tilt);
            Gripper { place, radius, mount, slip_force, max_tilt, lip }
        };
        let grippers = (0..ply.grippers()).map(gripper).collect();
        let sheet = Sheet {
            fabric,
            grippers,
            mold: layup.mold.clone(),
            areal_mass,
            rigidity,
            moment,
            tension,
            shear,
            shear_rate,
            gravity: settings.gravity,
            friction: settings.contact.friction,
            tack: settings.contact.tack,
            pitch,
            mesh,
            tool: layup.tool.clone(),
            table: table(layup, pitch),
        };
        let fixed = sheet.tool.as_ref().is_some_and(|tool| tool.fixed_pads.is_some());
        for (n, held) in sheet.held().iter().enumerate() {
            if fixed && held.len() < 2 {
                return Err(Error::SheetPadPoint { gripper: ply.id(n) });
            }
            // one node may be held at the gripper's own point alone; a pad that turns needs three
            if sheet.fabric.node_at(ply.place(n)).is_none() && !spans_an_area(held) {
                let [radius_mm, mesh_mm] = [radius, mesh].map(|x| x * 1e3);
                return Err(Error::SheetPadSmall { gripper: ply.id(n), radius_mm, mesh_mm });
            }
        }
        Ok(sheet)
    }

    /// The nodes that each gripper holds, with their distance from its middle in the fabric (m); its own point first.
    #[must_use]
    pub fn held(&self) -> Vec<Vec<(usize, [f64; 2])>> {
        let longer = self.fabric.length_factor;
        let held_nodes = |gripper: &Gripper| {
            // a fabric that is larger is held by a pad that is: it holds the same nodes, and does not stretch them
            let reach = longer * gripper.radius * (1.0 + 1e-9);
            let off = |place: &[f64; 2]| [0, 1].map(|n| longer * (place[n] - gripper.place[n]));
            let near = self.fabric.places.iter().map(off).enumerate();
            let own = self.fabric.node_at(gripper.place);
            let mut held: Vec<_> =
                near.filter(|(n, off)| Some(*n) == own || off[0].hypot(off[1]) <= reach).collect();
            held.sort_by_key(|(n, _)| (Some(*n) != own, *n));
            held
        };
        self.grippers.iter().map(held_nodes).collect()
    }
}

impl Fabric {
    /// The fabric of a ply as a layup divides it.
    ///
    /// # Errors
    /// [`Error::SheetPadsOverhang`] or [`Error::SheetPadOff`] if pads hang over the boundary.
    pub fn new(ply: &Ply, settings: &Settings) -> Result<Self, Error> {
        let ([a, b], grid) = (ply.cell, ply.grid);
        let (radius, overhang) = (settings.pad.radius, settings.sheet.overhang);
        let mesh = settings.sheet.mesh.unwrap_or(0.1 * pitch(ply));
        let fabric = match &ply.cut {
            Some(cut) => {
                // a pad holds the fabric under all of it, so it must lie within the outline
                let [low, high] = cut.outline.bounds();
                let rounding = 1e-9 * (high[0] - low[0]).max(high[1] - low[1]);
                let off = |n: &usize| cut.outline.depth(ply.place(*n)) < radius - rounding;
                if let Some(off) = (0..ply.grippers()).find(off) {
                    return Err(Error::SheetPadOff {
                        gripper: ply.id(off),
                        radius_mm: radius * 1e3,
                        inside_mm: cut.outline.depth(ply.place(off)) * 1e3,
                    });
                }
                let lines = lines_of_cut(ply, &cut.outline, radius, mesh);
                Fabric::cut(lines, &cut.outline, LEAST_SHARE)
            }
            None => {
                // a ply that ends at its grippers is as wide around them as its overhang
                if radius > overhang * (1.0 + 1e-9) {
                    let [radius_mm, overhang_mm] = [radius, overhang].map(|x| x * 1e3);
                    return Err(Error::SheetPadsOverhang { radius_mm, overhang_mm });
                }
                // lines of nodes meet the boundary, the middles of pads and their edges
                let along = |count: usize, cell: f64| {
                    if count == 1 {
                        return vec![0.0];
                    }
                    let last = (count - 1) as f64 * cell;
                    let mut meet = vec![-overhang, last + overhang];
                    for n in 0..count {
                        let at = n as f64 * cell;
                        meet.extend([at - radius, at, at + radius]);
                    }
                    lines(meet, mesh)
                };
                let width = if b > 0.0 { b } else { a };
                Fabric::rectangle([along(grid.nu, a), along(grid.nv, b)], width)
            }
        };
        // an error of the length scales the fabric, not the places where it is held
        Ok(fabric.enlarged(ply.length_factor))
    }
}

/// The lines of nodes of a ply that is cut: its lowest and highest coordinates, the grippers and the edges of their pads
/// where those stand in rows, and straight parts of the outline along the yarns, unless they are close to another line.
fn lines_of_cut(ply: &Ply, outline: &Outline, radius: f64, mesh: f64) -> [Vec<f64>; 2] {
    let [low, high] = outline.bounds();
    [0, 1].map(|n| {
        let rounding = 1e-9 * (high[n] - low[n]);
        let mut rows: Vec<f64> = (0..ply.grippers()).map(|k| ply.place(k)[n]).collect();
        rows.sort_by(f64::total_cmp);
        rows.dedup_by(|b, a| *b - *a <= rounding);
        // grippers that are in no rows would make lines close to each other: their pads hold what is near
        if rows.windows(2).any(|pair| pair[1] - pair[0] < CLOSE * mesh) {
            rows.clear();
        }
        let pads = rows.iter().flat_map(|row| [row - radius, row + radius]);
        let sides = outline.lines().filter(|[a, b]| {
            (a[n] - b[n]).abs() <= rounding && (a[1 - n] - b[1 - n]).abs() >= mesh
        });
        let others: Vec<f64> = pads.chain(sides.map(|[a, _]| a[n])).collect();
        let mut meet = rows;
        meet.extend([low[n], high[n]]);
        for other in others {
            if meet.iter().all(|line| (line - other).abs() >= CLOSE * mesh) {
                meet.push(other);
            }
        }
        lines(meet, mesh)
    })
}

/// Height of the table on which the ply of a layup lies as the motion begins (m); not above the lowest pad, which errors may put below it.
fn table(layup: &Layup, pitch: f64) -> Option<f64> {
    let height = layup.pick_up?.height;
    let pads = layup.motion.positions.first()?.iter().map(|p| p[2]);
    let [low, high] =
        pads.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)]);
    (high - height <= ON_TABLE * pitch).then_some(low.min(height))
}

/// Whether nodes, by their distances from one point (m), are not all on one line.
fn spans_an_area(held: &[(usize, [f64; 2])]) -> bool {
    let off = |n: usize, m: usize| [0, 1].map(|k| held[n].1[k] - held[m].1[k]);
    let cross = |a: [f64; 2], b: [f64; 2]| (a[0] * b[1] - a[1] * b[0]).abs();
    let size = |a: [f64; 2]| a[0] * a[0] + a[1] * a[1];
    (2..held.len()).any(|n| {
        let (a, b) = (off(1, 0), off(n, 0));
        cross(a, b) > 1e-3 * (size(a) * size(b)).sqrt()
    })
}

/// Stiffness of a mount along x, y and z (N/m); `None` if it is rigid and holds whatever pulls.
///
/// One that is rigid along some axes only has the stiffness `stiffest` (N/m) there, far more than the ply. Where the fabric
/// can slide under the pad of a rigid one, it gives by a ten-thousandth of the pitch (m) before it does.
fn mount_stiffness(pad: &PadSettings, stiffest: f64, pitch: f64) -> Option<[f64; 3]> {
    let PadSettings { lateral_stiffness: lateral, axial_stiffness: axial, slip_force, .. } = *pad;
    let lateral = lateral.or(slip_force.map(|force| force / (1e-4 * pitch)));
    (lateral.is_some() || axial.is_some()).then(|| {
        let [lateral, axial] = [lateral, axial].map(|k| k.unwrap_or(stiffest));
        [lateral, lateral, axial]
    })
}

/// The largest mesh (m) that puts a line of nodes between pads of a radius on grippers a pitch apart (m): half of the fabric
/// that is free between them.
#[must_use]
pub fn coarsest_mesh(pitch: f64, radius: f64) -> f64 {
    0.5 * pitch - radius
}

/// Shortest distance between neighboring grippers in the fabric (m).
#[must_use]
pub fn pitch(ply: &Ply) -> f64 {
    let [a, b] = ply.cell;
    if ply.grid != Grid::NONE {
        return if ply.grid.nv > 1 { a.min(b) } else { a };
    }
    let distance = |pair: &Neighbors| {
        let [[u, v], [p, q]] = pair.grippers.map(|n| ply.place(n));
        (p - u).hypot(q - v)
    };
    ply.neighbors().iter().map(distance).fold(f64::INFINITY, f64::min).min(a.max(b))
}

fn check(holds: bool, what: &'static str, value: f64, range: &'static str) -> Result<(), Error> {
    if holds && value.is_finite() { Ok(()) } else { Err(Error::SheetRange { what, value, range }) }
}
