//! How far a real cell may be from the scene.

use super::file::{ErrorsTable, MoldErrorsTable, ShareTable, Term};
use super::located::{CountOrNone, Located, Whole};
use super::quantity::{Measure, Quantity, Read, read_or};
use super::source::Document;
use super::usual::{AngleError, CellError};
use crate::Error;
use crate::store::shown::millimeters;
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
/// Largest factor of mass, bending and shear: a tenth to ten times.
const LARGEST_FACTOR: f64 = 10.0;
/// Largest error of a length: a woven ply does not stretch by more.
const LARGEST_LENGTH: f64 = 0.05;
/// Largest waviness, as a share of the wavelength: the waves' slope stays small.
const STEEPEST_WAVES: f64 = 0.02;

/// Checks the table `[errors]`; what it does not say is that of the cell, if there is one. `on_mold` says whether the scene has a mold.
pub(super) fn errors(
    table: &ErrorsTable,
    cell: Option<Errors>,
    ply: &Ply,
    on_mold: bool,
    document: &Document,
) -> Result<Errors, Error> {
    // what is not written comes from the cell; the largest shift is a part of the shorter side of the cells of the ply
    let default = cell.unwrap_or_default();
    let [a, b] = ply.cell;
    let reader = Reader { document, shift: LARGEST_SHIFT * a.min(b) };
    let turn = |term: &Option<Term<AngleError>>, other: errors::Term| {
        reader.term(term, other, [LARGEST_TURN; 2], "10 deg")
    };
    Ok(Errors {
        // how the sample of cells is drawn, and the share of it that must keep the limits
        seed: match &table.seed {
            Some(seed) => super::plan::number(seed, document)?,
            None => default.seed,
        },
        samples: match &table.samples {
            Some(samples) => reader.samples(samples)?,
            None => default.samples,
        },
        share: read_or(&table.share, default.share, document)?,
        // errors of the tool frame, of each gripper and of where it holds the ply
        frame: FrameErrors {
            position: reader.shift(&table.frame.position, default.frame.position)?,
            angle: turn(&table.frame.angle, default.frame.angle)?,
        },
        gripper: GripperErrors {
            position: reader.shift(&table.gripper.position, default.gripper.position)?,
            stroke: reader.term(
                &table.gripper.stroke,
                default.gripper.stroke,
                [LARGEST_STROKE; 2],
                "10 %",
            )?,
        },
        pick_up: PickUpErrors {
            offset: reader.shift(&table.pick_up.offset, default.pick_up.offset)?,
            yaw: turn(&table.pick_up.yaw, default.pick_up.yaw)?,
        },
        // errors of the ply
        material: MaterialErrors {
            areal_mass: reader.share(&table.material.areal_mass, default.material.areal_mass)?,
            bending: reader.share(&table.material.bending, default.material.bending)?,
            shear: reader.share(&table.material.shear, default.material.shear)?,
            length: reader.term(
                &table.material.length,
                default.material.length,
                [LARGEST_LENGTH; 2],
                "5 %",
            )?,
        },
        // without a mold there are no errors of one
        mold: match &table.mold {
            Some(mold) if !on_mold => {
                return Err(document.error(
                    mold.span.clone(),
                    "the scene has no mold that could be off",
                    "leave out `mold` of [errors], or say what the mold is in [mold]",
                ));
            }
            Some(mold) => MoldErrors {
                tilt: turn(&mold.value.tilt, default.mold.tilt)?,
                ..reader.mold(&mold.value, default.mold)?
            },
            None if !on_mold => MoldErrors::default(),
            None => default.mold,
        },
    })
}

/// The document of the terms, and the largest shift that they may have.
struct Reader<'a> {
    document: &'a Document,
    /// Largest shift (m).
    shift: f64,
}

impl Reader<'_> {
    /// A term up to a standard deviation and a bound (SI), or `other` where it is not written; `most` is how both are written.
    fn term<M: Measure>(
        &self,
        written: &Option<Term<M>>,
        other: errors::Term,
        [deviation, bound]: [f64; 2],
        most: &str,
    ) -> Result<errors::Term, Error> {
        let Some(term) = written else { return Ok(other) };
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

    /// A term of a value of the ply: a share, or a factor.
    fn share(
        &self,
        written: &Option<Located<ShareTable>>,
        other: errors::Term,
    ) -> Result<errors::Term, Error> {
        let Some(Located { value: ShareTable { deviation, bound, factor }, span }) = written else {
            return Ok(other);
        };
        let most = "a deviation of 30 %, a bound of 90 %";
        let [normal, even] = LARGEST_SHARE;

        // an error is given by one of three: a normal law, a bound or a factor
        match (deviation, bound, factor) {
            (Some(value), None, None) => {
                self.size(value, normal, most).map(errors::Term::Deviation)
            }
            (None, Some(value), None) => self.size(value, even, most).map(errors::Term::Bound),
            (None, None, Some(value)) => {
                let factor = value.read(self.document)?;
                if (1.0..=LARGEST_FACTOR).contains(&factor) {
                    return Ok(errors::Term::Factor(factor));
                }
                Err(self.document.error(
                    value.span.clone(),
                    format!("{} is no factor of an error", self.document.quoted(&value.span)),
                    "expected a factor from 1 to 10: 2 is half to double, both as likely",
                ))
            }
            (None, None, None) => Err(self.document.error(
                span.clone(),
                "the error has neither a deviation nor a bound nor a factor",
                "write one of them: `deviation`, the standard deviation of a normal law, `bound`, which no error exceeds, or `factor`",
            )),
            _ => Err(self.document.error(
                span.clone(),
                "the error has more than one of deviation, bound and factor",
                "keep one of them: `deviation`, the standard deviation of a normal law, `bound`, which no error exceeds, or `factor`",
            )),
        }
    }

    /// A size of zero or more up to a largest one (SI).
    fn size<M: Measure>(
        &self,
        value: &Quantity<M>,
        largest: f64,
        most: &str,
    ) -> Result<f64, Error> {
        let size = value.not_negative(self.document, &M::usual().within([0.0, largest]))?;
        if size <= largest {
            return Ok(size);
        }
        Err(self.document.error(
            value.span.clone(),
            format!("{} is too large for an error", self.document.quoted(&value.span)),
            format!("expected {} of zero or more, at most {most}", M::NAME),
        ))
    }

    fn shift(
        &self,
        written: &Option<Term<CellError>>,
        other: errors::Term,
    ) -> Result<errors::Term, Error> {
        let most = format!("{} mm, half of the shorter side of a cell", millimeters(self.shift));
        self.term(written, other, [self.shift; 2], &most)
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

    /// All of a mold's errors but the tilt.
    fn mold(&self, table: &MoldErrorsTable, other: MoldErrors) -> Result<MoldErrors, Error> {
        let offset = self.shift(&table.offset, other.offset)?;
        let wavelength = read_or(&table.wavelength, other.wavelength, self.document)?;
        let largest = STEEPEST_WAVES * wavelength;
        // the cell may have said how high the waves are, for longer ones
        if let (None, Some(length)) = (&table.waviness, &table.wavelength)
            && other.waviness.value() > largest
        {
            let least = millimeters(other.waviness.value() / STEEPEST_WAVES);
            return Err(self.document.error(
                length.span.clone(),
                "the waviness of the cell is too large for waves of this length",
                format!("expected {least} mm or more: waviness is at most 2 % of the wavelength; or write `waviness` here too"),
            ));
        }
        let waviness = match (&table.waviness, &table.wavelength) {
            (Some(term), None) if wavelength == 0.0 => {
                let waviness =
                    self.term(&table.waviness, other.waviness, [f64::INFINITY; 2], "")?;
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
                let most = format!("{} mm, 2 % of the wavelength", millimeters(largest));
                self.term(&table.waviness, other.waviness, [largest; 2], &most)?
            }
        };
        Ok(MoldErrors { offset, waviness, wavelength, ..MoldErrors::default() })
    }
}
