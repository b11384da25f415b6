//! The tables `steps.csv`, `trajectory.csv` and `motion.csv`, units in their headers.
//!
//! Numbers are in the shortest form that reads back to the same double. A measure without a meaning in
//! a step leaves its cells empty.
//!
//! Beside the poses stand the expected loads of the ply on the grippers where they are known, and where mounts yield their
//! preload and stiffness, see `loads.rs`.

use super::OutputError;
use super::loads::{Load, Loads, Stiffness};
use crate::result::ResultFile;
use ::csv::{Error, Writer};
use plydrape::draping::record::Step;
use plydrape::measure::{Name, Scope};
use plydrape::motion::{Attitudes, MotionError, TimedMotion};
use plydrape::ply::{GripperId, Ply, gripper_name};

/// One row a step: time (s), every measure and where it is, share in contact, how the solver ended.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn steps(result: &ResultFile) -> Result<String, Error> {
    let mut table = Writer::from_writer(Vec::new());
    let mut header = vec!["step", "t (s)"];
    let columns = measured().map(|m| [header_of(m), format!("{} at", m.measure().label())]);
    let columns: Vec<String> = columns.flatten().collect();
    header.extend(columns.iter().map(String::as_str));
    header.extend(["solver status", "iterations", "residual", "equilibria", "contact status"]);
    table.write_record(&header)?;
    for step in &result.steps {
        table.write_record(step_row(step))?;
    }
    text(table)
}

fn step_row(step: &Step) -> Vec<String> {
    let mut row = vec![step.step.to_string(), number(step.time)];
    for name in measured() {
        let worst = step.measures.get(name);
        row.push(worst.map(|w| number(w.value)).unwrap_or_default());
        row.push(worst.map(|w| w.at.clone()).unwrap_or_default());
    }
    row.push(step.solver.status.name().to_owned());
    row.push(step.solver.iterations.to_string());
    row.push(number(step.solver.residual));
    row.push(step.solver.equilibria.to_string());
    row.push(step.solver.contact.name().to_owned());
    row
}

/// The measures that a step may have.
fn measured() -> impl Iterator<Item = Name> {
    Name::ALL.iter().copied().filter(|name| name.measure().scope() != Scope::Whole)
}

/// The column of a measure, its unit in brackets.
fn header_of(name: Name) -> String {
    let measure = name.measure();
    format!("{} ({})", measure.label(), measure.unit().recorded)
}

/// One row a gripper and step: time (s), gripper `g2_0`, where the robot holds it (m), orientation (x, y, z, w), and the load
/// on it where that is known.
///
/// # Errors
/// [`OutputError`] if the states of the sheet cannot be read.
pub fn trajectory(result: &ResultFile) -> Result<String, OutputError> {
    let loads = Loads::of(result)?;
    let mut table = Poses::new(loads.as_ref())?;
    for step in &result.steps {
        let poses = step.grippers.iter().map(|g| (g.id, g.commanded(), g.quaternion));
        table.add(step.time, poses)?;
    }
    Ok(text(table.table)?)
}

/// The table of [`motion`] for a plan at its rate, with the loads where they are known; none of a simulated drape.
///
/// # Errors
/// As [`motion`], if plan and steps do not belong together, or [`OutputError`] if the states of the sheet cannot be read.
pub fn planned_motion(result: &ResultFile) -> Result<Option<String>, OutputError> {
    match (&result.plan, result.motion()?) {
        (Some(plan), Some((timed, attitudes))) => {
            let (ply, loads) = (&result.scene.ply, Loads::of(result)?);
            sampled(&timed, &attitudes, ply, plan.rate, loads.as_ref()).map(Some)
        }
        _ => Ok(None),
    }
}

/// The table of [`trajectory`] for a timed motion without loads, sampled at a rate (Hz), the last sample at its end.
///
/// A scene can follow it: `[motion]`, `kind = "file"`.
///
/// # Errors
/// [`OutputError::Motion`] if motion, attitudes and ply differ in grippers, or the rate gives no or too
/// many samples.
pub fn motion(
    motion: &TimedMotion,
    attitudes: &Attitudes,
    ply: &Ply,
    rate: f64,
) -> Result<String, OutputError> {
    sampled(motion, attitudes, ply, rate, None)
}

fn sampled(
    motion: &TimedMotion,
    attitudes: &Attitudes,
    ply: &Ply,
    rate: f64,
    loads: Option<&Loads>,
) -> Result<String, OutputError> {
    for found in [motion.grippers(), attitudes.grippers()] {
        if found != ply.grippers() {
            return Err(MotionError::Grippers { found, expected: ply.grippers() }.into());
        }
    }
    let mut table = Poses::new(loads)?;
    for time in motion.samples(rate)? {
        let poses = motion.at(time).into_iter().zip(attitudes.at(time)).enumerate();
        table.add(time, poses.map(|(n, (place, quaternion))| (ply.id(n), place, quaternion)))?;
    }
    Ok(text(table.table)?)
}

/// The columns of a gripper's pose at a time.
const POSE: [&str; 9] = ["t (s)", "gripper", "x (m)", "y (m)", "z (m)", "qx", "qy", "qz", "qw"];
/// Those of the load on it.
const LOAD: [&str; 3] = ["load x (N)", "load y (N)", "load z (N)"];
/// Those of its mount. The stiffness is the same in every row, because a comment above the header stops most readers.
const MOUNT: [&str; 5] = [
    "preload x (mm)",
    "preload y (mm)",
    "preload z (mm)",
    "lateral stiffness (N/mm)",
    "axial stiffness (N/mm)",
];

/// A table of poses under way, with the loads beside them.
struct Poses<'a> {
    table: Writer<Vec<u8>>,
    loads: Option<&'a Loads>,
}

impl<'a> Poses<'a> {
    fn new(loads: Option<&'a Loads>) -> Result<Self, Error> {
        let mut header = POSE.to_vec();
        if let Some(loads) = loads {
            header.extend(LOAD);
            header.extend(loads.mounts.iter().flat_map(|_| MOUNT));
        }
        let mut table = Writer::from_writer(Vec::new());
        table.write_record(header)?;
        Ok(Poses { table, loads })
    }

    /// Adds a row for the pose of each gripper at a time (s).
    fn add(
        &mut self,
        time: f64,
        poses: impl Iterator<Item = (GripperId, [f64; 3], [f64; 4])>,
    ) -> Result<(), Error> {
        let known = self.loads.and_then(|loads| loads.at(time));
        for (n, (id, position, quaternion)) in poses.enumerate() {
            let mut row = vec![number(time), gripper_name(id)];
            row.extend(position.map(number));
            row.extend(quaternion.map(number));
            if let Some(loads) = self.loads {
                row.extend(load_row(known.as_ref().map(|all| &all[n]), loads.mounts.as_ref()));
            }
            self.table.write_record(&row)?;
        }
        Ok(())
    }
}

/// The fields of a load, empty where none is known, and of the mount, if it yields.
fn load_row(load: Option<&Load>, mount: Option<&Stiffness>) -> Vec<String> {
    let fields = |vector: Option<[f64; 3]>| match vector {
        Some(vector) => vector.map(number),
        None => Default::default(),
    };
    let mut row = fields(load.map(|load| load.force)).to_vec();
    if let Some(Stiffness { lateral, axial }) = mount {
        row.extend(fields(load.map(|load| load.preload.map(|c| c * 1e3))));
        row.extend([lateral, axial].map(|k| k.map(number).unwrap_or_default()));
    }
    row
}

/// The shortest decimal that reads back to the same double.
pub(super) fn number(value: f64) -> String {
    format!("{value:?}")
}

pub(super) fn text(table: Writer<Vec<u8>>) -> Result<String, Error> {
    let bytes = table.into_inner().map_err(|e| e.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::draping::record::Worst;

    fn rows(text: &str) -> Vec<Vec<String>> {
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        reader.records().map(|r| r.unwrap().iter().map(str::to_owned).collect()).collect()
    }

    /// The header is what robot programs are told to expect.
    #[test]
    fn trajectory_has_exactly_the_promised_columns() {
        let text = trajectory(&sample::draped(4, 2, 3)).unwrap();
        assert_eq!(text.lines().next(), Some("t (s),gripper,x (m),y (m),z (m),qx,qy,qz,qw"));
    }

    /// Time, position and orientation read back to the same bits, step by step, gripper by gripper.
    #[test]
    fn trajectory_reads_back_to_the_same_numbers() {
        let mut result = sample::draped(4, 2, 3);
        result.steps[1].grippers[0].position = [1.0 / 3.0, 1e-300, -0.0];
        let rows = rows(&trajectory(&result).unwrap());
        let mut rows = rows.iter();
        for step in &result.steps {
            for gripper in &step.grippers {
                let row = rows.next().unwrap();
                assert_eq!(row[1], gripper_name(gripper.id));
                let written: Vec<f64> =
                    [0, 2, 3, 4, 5, 6, 7, 8].map(|k| row[k].parse().unwrap()).to_vec();
                let mut expected = vec![step.time];
                expected.extend(gripper.position);
                expected.extend(gripper.quaternion);
                let bits = |list: &[f64]| list.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(&written), bits(&expected));
            }
        }
        assert!(rows.next().is_none());
    }

    /// A place is words and may hold commas, as "edge …, second span"; an unknown measure is an empty cell.
    #[test]
    fn steps_hold_places_as_they_are_and_empty_cells() {
        let mut result = sample::draped(4, 2, 3);
        let at = "edge g0_0–g1_0, second span";
        let worst = Worst { value: 1.25, at: at.into(), place: Some([0.0; 3]) };
        result.steps[0].measures.set(Name::Slack, Some(worst));
        result.steps[0].measures.set(Name::Bridging, None);
        let text = steps(&result).unwrap();
        let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
        let column = |name| header.iter().position(|h| *h == name).unwrap();
        let rows = rows(&text);
        assert_eq!(rows.len(), 3);
        assert_eq!(rows[0][column("slack (mm)")], "1.25");
        assert_eq!(rows[0][column("slack at")], at);
        assert_eq!(rows[0][column("bridging (mm)")], "");
        assert_eq!(rows[2][column("solver status")], "converged");
    }
}
