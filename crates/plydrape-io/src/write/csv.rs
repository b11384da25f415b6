//! The tables `steps.csv`, `trajectory.csv` and `motion.csv`, units in their headers.
//!
//! Numbers are in the shortest form that reads back to the same double; what is rounding beside the other components of its vector is zero,
//! see `without_rounding`. All of them are of the model that decides: a measure that it does
//! not evaluate has no column, and one without a meaning in a step leaves its cells empty. How the solver ended is there where catenaries
//! decide.
//!
//! Beside the poses are the expected loads of the ply on the grippers, and where mounts yield their preload and stiffness, see `loads.rs`. Where the scene says when pads let go, the column `vacuum` is 1 as long as a gripper
//! holds and 0 from its release on; the tables then end with the last release.

use crate::Error;
use crate::result::{ResultFile, Turned};
use crate::write::loads::{Load, Loads, Stiffness};
use ::csv::Writer;
use plydrape::LayupError;
use plydrape::draping::record::CatenaryStep;
use plydrape::layup::Model;
use plydrape::measure::Name;
use plydrape::motion::{Attitudes, TimedMotion};
use plydrape::outcome::Step;
use plydrape::ply::{GripperId, Ply, gripper_name};
use plydrape::sheet::Event;
use plydrape::sheet::event::{holds, last_release};

/// One row a step: time (s), every measure of the model that decides and where it is, of catenaries how the solver ended.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn steps(result: &ResultFile) -> Result<String, Error> {
    let mut table = Writer::from_writer(Vec::new());
    let mut header = vec!["step", "t (s)"];
    let measured = measured(&result.steps);
    let columns = measured.iter().map(|m| [header_of(*m), format!("{} at", m.measure().label())]);
    let columns: Vec<String> = columns.flatten().collect();
    header.extend(columns.iter().map(String::as_str));
    if result.model() == Model::Catenaries {
        header.extend(["solver status", "iterations", "residual", "equilibria", "contact status"]);
    }
    table.write_record(&header)?;
    for step in &result.steps {
        table.write_record(step_row(&measured, step))?;
    }
    text(table)
}

fn step_row(measured: &[Name], step: &Step) -> Vec<String> {
    let mut row = vec![step.step.to_string(), number(step.time)];
    for name in measured {
        let worst = step.measures.get(*name);
        row.push(worst.map(|w| number(w.value)).unwrap_or_default());
        row.push(worst.map(|w| cell(&w.at)).unwrap_or_default());
    }
    if let Some(CatenaryStep { solver, .. }) = &step.catenaries {
        row.push(solver.status.name().to_owned());
        row.push(solver.iterations.to_string());
        row.push(number(solver.residual));
        row.push(solver.equilibria.to_string());
        row.push(solver.contact.name().to_owned());
    }
    row
}

/// The measures that some step has.
fn measured(steps: &[Step]) -> Vec<Name> {
    let known = |name: &Name| steps.iter().any(|step| step.measures.get(*name).is_some());
    Name::ALL.iter().copied().filter(known).collect()
}

/// The column of a measure, its unit in brackets.
fn header_of(name: Name) -> String {
    let measure = name.measure();
    format!("{} ({})", measure.label(), measure.unit().recorded)
}

/// One row a gripper and step: time (s), gripper `g2_0`, where the robot holds it (m), orientation (x, y, z, w), the load
/// on it, and its vacuum where pads let go; a last one at the release where that is later.
///
/// # Errors
/// If the table cannot be formed; memory apart there is no known case.
pub fn trajectory(result: &ResultFile) -> Result<String, Error> {
    let loads = Loads::new(result);
    let mut table = Poses::new(loads.as_ref(), vacuum(result))?;
    let end = result.steps.last().map(|step| step.time);
    let released = end.and_then(|end| result.steps.last().zip(release_after(result, end)));
    let steps = result.steps.iter().map(|step| (step, step.time));
    for (step, time) in steps.chain(released) {
        let poses = step.grippers.iter().map(|g| (g.id, g.commanded, g.quaternion));
        table.add(time, poses)?;
    }
    text(table.table)
}

/// The table of [`motion`] for a plan at its rate, with the loads and where pads let go with the vacuum, until they do; `None` of a simulated
/// drape.
///
/// # Errors
/// As [`motion`], if plan and steps do not belong together.
pub fn planned_motion(result: &ResultFile) -> Result<Option<String>, Error> {
    match (&result.plan, result.motion()?) {
        (Some(plan), Some(Turned { motion, attitudes })) => {
            let (ply, loads) = (&result.scene.ply, Loads::new(result));
            let table = Poses::new(loads.as_ref(), vacuum(result))?;
            let until = release_after(result, motion.duration());
            sampled(motion, attitudes, ply, plan.rate, table, until).map(Some)
        }
        _ => Ok(None),
    }
}

/// The table of [`trajectory`] for a timed motion without loads, sampled at a rate (Hz), the last sample at its end.
///
/// A scene can follow it: `[motion]`, `kind = "file"`.
///
/// # Errors
/// [`Error::NotPossible`] if motion, attitudes and ply differ in grippers, or the rate gives no or too
/// many samples.
pub fn motion(
    motion: &TimedMotion,
    attitudes: &Attitudes,
    ply: &Ply,
    rate: f64,
) -> Result<String, Error> {
    sampled(motion, attitudes, ply, rate, Poses::new(None, None)?, None)
}

fn sampled(
    motion: &TimedMotion,
    attitudes: &Attitudes,
    ply: &Ply,
    rate: f64,
    mut table: Poses,
    until: Option<f64>,
) -> Result<String, Error> {
    for found in [motion.grippers(), attitudes.grippers()] {
        if found != ply.grippers() {
            return Err(LayupError::MotionGrippers { found, expected: ply.grippers() }.into());
        }
    }
    for time in times(motion, rate, until)? {
        let at = time.min(motion.duration());
        let poses = motion.at(at).into_iter().zip(attitudes.at(at)).enumerate();
        table.add(time, poses.map(|(n, (place, quaternion))| (ply.id(n), place, quaternion)))?;
    }
    text(table.table)
}

/// The times (s) at which the motion of a plan is written: at a rate (Hz) to its end, and on until the last pads let go.
///
/// # Errors
/// As [`TimedMotion::samples`].
pub(crate) fn written_times(
    result: &ResultFile,
    motion: &TimedMotion,
    rate: f64,
) -> Result<Vec<f64>, LayupError> {
    times(motion, rate, release_after(result, motion.duration()))
}

fn times(motion: &TimedMotion, rate: f64, until: Option<f64>) -> Result<Vec<f64>, LayupError> {
    let mut times = motion.samples(rate)?;
    if let Some(until) = until {
        // grippers stand while they press
        times.extend(motion.standing_samples(rate, until - motion.duration())?);
        times.push(until);
    }
    Ok(times)
}

/// What the column of the vacuum is made of; `None` where pads hold to the end.
fn vacuum(result: &ResultFile) -> Option<&[Event]> {
    result.scene.release.as_ref().map(|_| result.events())
}

/// When the last pads let go (s), if that is after a time.
fn release_after(result: &ResultFile, end: f64) -> Option<f64> {
    last_release(result.events()).filter(|last| *last > end)
}

/// The columns of a gripper's pose at a time.
const POSE: [&str; 9] = ["t (s)", "gripper", "x (m)", "y (m)", "z (m)", "qx", "qy", "qz", "qw"];
/// The columns of the load on a gripper.
const LOAD: [&str; 3] = ["load x (N)", "load y (N)", "load z (N)"];
/// The columns of a gripper's mount. The stiffness is the same in every row, because a comment above the header stops most readers.
const MOUNT: [&str; 5] = [
    "preload x (mm)",
    "preload y (mm)",
    "preload z (mm)",
    "lateral stiffness (N/mm)",
    "axial stiffness (N/mm)",
];

/// The column of its vacuum.
const VACUUM: &str = "vacuum";

/// A table of poses under way, with the loads and what switches the vacuum beside them.
struct Poses<'a> {
    table: Writer<Vec<u8>>,
    loads: Option<&'a Loads>,
    vacuum: Option<&'a [Event]>,
}

impl<'a> Poses<'a> {
    fn new(loads: Option<&'a Loads>, vacuum: Option<&'a [Event]>) -> Result<Self, Error> {
        let mut header = POSE.to_vec();
        if let Some(loads) = loads {
            header.extend(LOAD);
            header.extend(loads.mounts.iter().flat_map(|_| MOUNT));
        }
        header.extend(vacuum.map(|_| VACUUM));
        let mut table = Writer::from_writer(Vec::new());
        table.write_record(header)?;
        Ok(Poses { table, loads, vacuum })
    }

    /// Adds a row for the pose of each gripper at a time (s).
    fn add(
        &mut self,
        time: f64,
        poses: impl Iterator<Item = (GripperId, [f64; 3], [f64; 4])>,
    ) -> Result<(), Error> {
        let known = self.loads.and_then(|loads| loads.interpolate(time));
        for (n, (id, position, quaternion)) in poses.enumerate() {
            let mut row = vec![number(time), gripper_name(id)];
            row.extend(without_rounding(position).map(number));
            row.extend(without_rounding(quaternion).map(number));
            let on = self.vacuum.is_none_or(|events| holds(events, id, time));
            if let Some(loads) = self.loads {
                let load = known.as_ref().map(|all| if on { &all[n] } else { &Load::NONE });
                row.extend(load_row(load, loads.mounts.as_ref()));
            }
            row.extend(self.vacuum.map(|_| u8::from(on).to_string()));
            self.table.write_record(&row)?;
        }
        Ok(())
    }
}

/// The fields of a load, empty where none is known, and of the mount, if it yields.
fn load_row(load: Option<&Load>, mount: Option<&Stiffness>) -> Vec<String> {
    let fields = |vector: Option<[f64; 3]>| match vector {
        Some(vector) => without_rounding(vector).map(number),
        None => Default::default(),
    };
    let mut row = fields(load.map(|load| load.force)).to_vec();
    if let Some(Stiffness { lateral, axial }) = mount {
        row.extend(fields(load.map(|load| load.preload.map(|c| c * 1e3))));
        row.extend([lateral, axial].map(|k| k.map(number).unwrap_or_default()));
    }
    row
}

/// A text of a scene as a cell: one that a spreadsheet would take for a formula begins with an apostrophe, which it takes for text.
pub(crate) fn cell(text: &str) -> String {
    if is_formula(text) { format!("'{text}") } else { text.to_owned() }
}

/// A text as a comment, the parts of which between commas no spreadsheet takes for formulas.
pub(crate) fn comment(text: &str) -> String {
    let parts: Vec<String> = text.split(',').map(cell).collect();
    format!("# {}\n", parts.join(","))
}

fn is_formula(text: &str) -> bool {
    text.starts_with(['=', '+', '-', '@', '\t', '\r'])
}

/// Numbers of one kind, those smaller than a double's relative spacing times the largest of them zero: a component of 1e-33 beside one of 0.1
/// is what rounding has left, and says nothing.
pub(crate) fn without_rounding<V: AsMut<[f64]>>(mut values: V) -> V {
    let numbers = values.as_mut();
    let least = f64::EPSILON * numbers.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    for value in numbers.iter_mut().filter(|value| value.abs() <= least) {
        *value = 0.0;
    }
    values
}

/// The shortest decimal that reads back to the same double.
pub(crate) fn number(value: f64) -> String {
    format!("{value:?}")
}

pub(crate) fn text(table: Writer<Vec<u8>>) -> Result<String, Error> {
    let bytes = table.into_inner().map_err(|e| ::csv::Error::from(e.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use plydrape::measure::Worst;

    fn rows(text: &str) -> Vec<Vec<String>> {
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        reader.records().map(|r| r.unwrap().iter().map(str::to_owned).collect()).collect()
    }

    /// The header is the one that robot programs expect.
    #[test]
    fn trajectory_has_exactly_the_promised_columns() {
        let text = trajectory(&sample::draped(4, 2, 3)).unwrap();
        let header = "t (s),gripper,x (m),y (m),z (m),qx,qy,qz,qw,load x (N),load y (N),load z (N)";
        assert_eq!(text.lines().next(), Some(header));
    }

    /// Time, position and orientation read back to the same bits, step by step, gripper by gripper; of a vector what is rounding beside its
    /// largest component is zero, and what is just above stays.
    #[test]
    fn trajectory_reads_back_to_the_same_numbers() {
        let mut result = sample::draped(4, 2, 3);
        result.steps[1].grippers[0].commanded = [1.0, 3e-16, -3e-33];
        let rows = rows(&trajectory(&result).unwrap());
        let mut rows = rows.iter();
        for step in &result.steps {
            for gripper in &step.grippers {
                let row = rows.next().unwrap();
                assert_eq!(row[1], gripper_name(gripper.id));
                let written: Vec<f64> =
                    [0, 2, 3, 4, 5, 6, 7, 8].map(|k| row[k].parse().unwrap()).to_vec();
                let mut expected = vec![step.time];
                let [x, y, z] = gripper.commanded;
                expected.extend([x, y, if z == -3e-33 { 0.0 } else { z }]);
                expected.extend(gripper.quaternion);
                // zero has no sign
                let expected: Vec<f64> = expected.into_iter().map(|value| value + 0.0).collect();
                let bits = |list: &[f64]| list.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(&written), bits(&expected));
            }
        }
        assert!(rows.next().is_none());
    }

    /// A body may be called `=1+1`, and places name it; numbers stay numbers, whatever their sign.
    #[test]
    fn a_text_of_the_scene_is_no_formula_of_a_spreadsheet() {
        for name in ["=1+1", "+1", "-x", "@SUM(A1)", "=HYPERLINK(\"a\",\"b\")"] {
            let mut result = sample::draped(4, 2, 3);
            let worst = Worst { value: -1.25, at: name.into(), place: None };
            result.steps[0].measures.set(Name::Slack, Some(worst));
            let rows = rows(&steps(&result).unwrap());
            assert!(rows[0].iter().any(|cell| *cell == format!("'{name}")), "{name}");
            assert!(rows[0].iter().any(|cell| cell == "-1.25"));
            for cell in rows.iter().flatten().filter(|cell| cell.starts_with(['=', '+', '-', '@']))
            {
                assert!(cell.parse::<f64>().is_ok(), "{cell}");
            }
        }
        assert_eq!(comment("near a,=1+1, -2 mm"), "# near a,'=1+1, -2 mm\n");
    }

    /// A place is words and may hold commas, as "edge …, second span"; an unknown measure is an empty cell.
    #[test]
    fn steps_hold_places_as_they_are_and_empty_cells() {
        let mut result = sample::draped(4, 2, 3);
        let at = "edge g0_0–g1_0, second span";
        let worst = Worst { value: 1.25, at: at.into(), place: Some([0.0; 3]) };
        result.steps[0].measures.set(Name::Slack, Some(worst));
        let text = steps(&result).unwrap();
        let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
        let column = |name| header.iter().position(|h| *h == name).unwrap();
        let rows = rows(&text);
        assert_eq!(rows.len(), 3);
        assert_eq!(rows[0][column("slack (mm)")], "1.25");
        assert_eq!(rows[0][column("slack at")], at);
        assert_eq!(rows[0][column("landing error (mm)")], "");
        assert_eq!(rows[2][column("solver status")], "converged");
    }
}
