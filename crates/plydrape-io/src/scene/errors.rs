//! How far a real cell may be from the scene.

use super::file::{ErrorsTable, MoldErrorsTable, Term};
use super::located::{CountOrNone, Located, Whole};
use super::quantity::{Angle, Length, Measure, Quantity, Ratio};
use super::source::Document;
use super::usual;
use crate::Error;
use crate::store::shown::millimetres;
use plydrape::errors::{
    self, Errors, FrameErrors, GripperErrors, MaterialErrors, MoldErrors, PickUpErrors,
};
use plydrape::ply::Ply;

/// Most cells that may be drawn: each is a drape.
const MOST_SAMPLES: usize = 100_000;
/// Largest shift, as a share of the shorter side of a cell: grippers that are farther off meet.
const LARGEST_SHIFT: f64 = 0.5;
/// Largest turn (rad): 10°, because turns are small against 1.
const LARGEST_TURN: f64 = std::f64::consts::PI / 18.0;
/// Largest error of a stroke.
const LARGEST_STROKE: f64 = 0.1;
/// Largest standard deviation and bound of mass, bending and shear: three deviations, or the bound, leave a tenth.
const LARGEST_SHARE: [f64; 2] = [0.3, 0.9];
/// Largest error of a length: a woven ply does not stretch by more.
const LARGEST_LENGTH: f64 = 0.05;
/// Largest waviness, as a share of the wavelength: the waves' slope stays small.
const STEEPEST_WAVES: f64 = 0.02;

/// Checks the table `[errors]`; `on_mold` says whether the scene has a mold.
pub(super) fn errors(
    table: &ErrorsTable,
    ply: &Ply,
    on_mold: bool,
    document: &Document,
) -> Result<Errors, Error> {
    let default = Errors::default();
    let [a, b] = ply.cell;
    let reader = Reader { document, shift: LARGEST_SHIFT * a.min(b) };
    let turn = |term: &Option<Term<Angle>>| reader.term(term, [LARGEST_TURN; 2], "10 deg");
    let share = |term: &Option<Term<Ratio>>| {
        reader.term(term, LARGEST_SHARE, "a deviation of 30 %, a bound of 90 %")
    };
    Ok(Errors {
        seed: match &table.seed {
            Some(seed) => super::plan::number(seed, document)?,
            None => default.seed,
        },
        samples: match &table.samples {
            Some(samples) => reader.samples(samples)?,
            None => default.samples,
        },
        share: match &table.share {
            Some(share) => reader.accepted(share)?,
            None => default.share,
        },
        frame: FrameErrors {
            position: reader.shift(&table.frame.position)?,
            angle: turn(&table.frame.angle)?,
        },
        gripper: GripperErrors {
            position: reader.shift(&table.gripper.position)?,
            stroke: reader.term(&table.gripper.stroke, [LARGEST_STROKE; 2], "10 %")?,
        },
        pick_up: PickUpErrors {
            offset: reader.shift(&table.pick_up.offset)?,
            yaw: turn(&table.pick_up.yaw)?,
        },
        material: MaterialErrors {
            areal_mass: share(&table.material.areal_mass)?,
            bending: share(&table.material.bending)?,
            shear: share(&table.material.shear)?,
            length: reader.term(&table.material.length, [LARGEST_LENGTH; 2], "5 %")?,
        },
        mold: match &table.mold {
            Some(_) if !on_mold => return Err(reader.no_mold(table)),
            Some(mold) => MoldErrors { tilt: turn(&mold.value.tilt)?, ..reader.mold(&mold.value)? },
            None => default.mold,
        },
    })
}

/// What every term is held against.
struct Reader<'a> {
    document: &'a Document,
    /// Largest shift (m).
    shift: f64,
}

impl Reader<'_> {
    /// A term up to a standard deviation and a bound (SI); `most` is how both are written.
    fn term<M: Measure>(
        &self,
        written: &Option<Term<M>>,
        [deviation, bound]: [f64; 2],
        most: &str,
    ) -> Result<errors::Term, Error> {
        let Some(term) = written else { return Ok(errors::Term::NONE) };
        match (&term.value.deviation, &term.value.bound) {
            (Some(value), None) => self.size(value, deviation, most).map(errors::Term::Deviation),
            (None, Some(value)) => self.size(value, bound, most).map(errors::Term::Bound),
            (deviation, _) => {
                let fault = match deviation {
                    Some(_) => "the error has both a deviation and a bound",
                    None => "the error has neither a deviation nor a bound",
                };
                let help = "write one of both: `deviation`, the standard deviation of a normal law, or `bound`, which no error exceeds";
                Err(self.document.error(term.span.clone(), fault, help))
            }
        }
    }

    /// A size of zero or more up to a largest one (SI).
    fn size<M: Measure>(
        &self,
        value: &Quantity<M>,
        largest: f64,
        most: &str,
    ) -> Result<f64, Error> {
        let size = value.not_negative(self.document)?;
        if size <= largest {
            return Ok(size);
        }
        Err(self.document.error(
            value.span.clone(),
            format!("{} is too large for an error", self.document.quoted(&value.span)),
            format!("{} of zero or more is wanted, at most {most}", M::NAME),
        ))
    }

    fn shift(&self, written: &Option<Term<Length>>) -> Result<errors::Term, Error> {
        let most = format!("{} mm, half of the shorter side of a cell", millimetres(self.shift));
        self.term(written, [self.shift; 2], &most)
    }

    fn samples(&self, written: &Located<CountOrNone>) -> Result<usize, Error> {
        let Whole(value) = written.value;
        match usize::try_from(value) {
            Ok(value) if value <= MOST_SAMPLES => Ok(value),
            _ => Err(self.document.error(
                written.span.clone(),
                match value {
                    1.. => format!("{value} cells are too many for a sample"),
                    _ => format!("{value} cells are no sample"),
                },
                format!("1 to {MOST_SAMPLES} cells are possible; 0 leaves all errors out"),
            )),
        }
    }

    fn accepted(&self, written: &Quantity<Ratio>) -> Result<f64, Error> {
        let share = written.positive(self.document)?;
        if share <= 1.0 {
            return Ok(share);
        }
        Err(self.document.error(
            written.span.clone(),
            format!("{} is more than all of the cells", self.document.quoted(&written.span)),
            "a share above 0, up to 1 is wanted, e.g. \"95 %\"",
        ))
    }

    /// All of a mold's errors but the tilt.
    fn mold(&self, table: &MoldErrorsTable) -> Result<MoldErrors, Error> {
        let offset = self.shift(&table.offset)?;
        let wavelength = match &table.wavelength {
            Some(length) => length.size(self.document, &usual::WAVES)?,
            None => 0.0,
        };
        let largest = STEEPEST_WAVES * wavelength;
        let waviness = match (&table.waviness, &table.wavelength) {
            (Some(term), None) => {
                let waviness = self.term(&table.waviness, [f64::INFINITY; 2], "")?;
                if !waviness.is_zero() {
                    return Err(self.document.error(
                        term.span.clone(),
                        "the waviness has no wavelength",
                        "write how long the waves are, e.g. wavelength = \"150 mm\"",
                    ));
                }
                waviness
            }
            _ => {
                let most = format!("{} mm, 2 % of the wavelength", millimetres(largest));
                self.term(&table.waviness, [largest; 2], &most)?
            }
        };
        Ok(MoldErrors { offset, waviness, wavelength, ..MoldErrors::default() })
    }

    fn no_mold(&self, table: &ErrorsTable) -> Error {
        let message = "the scene has no mold that could be off";
        let help = "leave out `mold` of [errors], or say what the mold is in [mold]";
        match &table.mold {
            Some(mold) => self.document.error(mold.span.clone(), message, help),
            None => self.document.error_anywhere(message, help),
        }
    }
}
