//! What the numbers of a sheet must be, when they are written and when they are read.

use super::array::{ARRAYS, Array, OF_MESH, Sizes, Values, arrays};
use super::{SheetMesh, SheetState};

/// Largest number in size: its square and its cube are far from overflow.
const LARGEST: f64 = 1e30;
/// Room for the length of a quaternion.
const UNIT: f64 = 1e-3;
/// Largest whole number, as NumPy's int32.
const MOST: u32 = i32::MAX as u32;

/// The sizes of a sheet whose arrays belong together.
pub(super) fn sizes(mesh: &SheetMesh, states: usize) -> Sizes {
    Sizes {
        states,
        nodes: mesh.places.len(),
        segments: mesh.segments.len(),
        cells: mesh.cells.len(),
        grippers: mesh.grippers,
        releases: mesh.releases,
    }
}

/// Refuses a mesh whose arrays have other lengths than they must, or name nodes that it has not.
pub(super) fn mesh(mesh: &SheetMesh, landing_step: &[u32], sizes: &Sizes) -> Result<(), String> {
    for (array, values) in ARRAYS[..OF_MESH].iter().zip(mesh.values(landing_step)) {
        sound(array, values, sizes)?;
        if let ("segments" | "cells", Values::Index(nodes)) = (array.name, values) {
            refuse(array, nodes, "there is no such node", |node| {
                usize::try_from(*node).is_ok_and(|node| node < sizes.nodes)
            })?;
        }
    }
    Ok(())
}

/// Refuses a state whose arrays have other lengths than they must, or that comes before the one `after` which it is listed.
pub(super) fn state(
    state: &SheetState,
    sizes: &Sizes,
    after: Option<(u32, f64)>,
) -> Result<(), String> {
    // arrays as long as the mesh asks for, also that of pads that let go
    let releases = state.pad_holds.is_some();
    for (array, values) in arrays(releases)[OF_MESH..].iter().zip(state.values()) {
        sound(array, values, sizes)?;
    }
    if sizes.releases != releases {
        let pads = |releases: bool| if releases { sizes.grippers } else { 0 };
        let (expected, found) = (pads(sizes.releases), pads(releases));
        return Err(length("pad_holds", found, expected));
    }

    // rotations of pads are unit quaternions
    for (n, q) in state.pad_rotation.iter().enumerate() {
        let length = q.iter().map(|q| q * q).sum::<f64>().sqrt();
        if (length - 1.0).abs() > UNIT {
            let rule = "it is the length of a quaternion, which must be 1";
            return Err(value("pad_rotation", n, length, rule));
        }
    }

    // a state does not come before the one that is listed before it
    let (step, time) = after.unwrap_or((1, f64::NEG_INFINITY));
    let rule = "states come in the order of steps and times, from step 1 on";
    if state.step < step {
        return Err(value("step", 0, f64::from(state.step), rule));
    }
    if state.time < time {
        return Err(value("time", 0, state.time, rule));
    }
    Ok(())
}

fn sound(array: &Array, values: Values, sizes: &Sizes) -> Result<(), String> {
    let (found, expected) = (values.len(), array.count(sizes));
    if found != expected {
        return Err(length(array.name, found, expected));
    }
    match values {
        Values::Real(values) => {
            // a node has no height where there is no mold
            let may_lack = array.name == "height";
            refuse(array, values, "expected a finite number", |value| {
                value.abs() <= LARGEST || (may_lack && value.is_nan())
            })
        }
        Values::Index(values) => refuse(array, values, "it is too large", |value| *value <= MOST),
        Values::Flag(_) => Ok(()),
    }
}

fn refuse<T: Copy + Into<f64>>(
    array: &Array,
    values: &[T],
    rule: &str,
    fits: impl Fn(&T) -> bool,
) -> Result<(), String> {
    match values.iter().position(|value| !fits(value)) {
        None => Ok(()),
        Some(index) => Err(value(array.name, index, values[index].into(), rule)),
    }
}

/// An array of another length than the sheet.
fn length(array: &str, found: usize, expected: usize) -> String {
    format!("`{array}` of the sheet has {found} numbers, not {expected}")
}

/// A number that is not what it must be.
fn value(array: &str, index: usize, value: f64, rule: &str) -> String {
    format!("`{array}[{index}]` of the sheet is {value}: {rule}")
}
