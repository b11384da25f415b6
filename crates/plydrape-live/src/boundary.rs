//! The functions that the page calls, over the memory that it shares with this module.
//!
//! The page asks for [`room`] for the text of a scene, writes it there, calls [`solve`] and reads the answer, this many bytes from
//! where [`told`] points. Texts are all that passes, so three functions of numbers are enough, and no tool has to
//! write glue code for them. Their names must stay as they are in the compiled module; Rust counts an attribute for that as unsafe,
//! because two functions of one name could be exchanged. That is the only exception from the lint, there is no unsafe block.

#![allow(unsafe_code)]

use crate::answer::{Mold, answer};
use std::cell::RefCell;

thread_local! {
    static ASKED: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static TOLD: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Room for a scene of this many bytes; the page writes it there.
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *mut u8 {
    ASKED.with_borrow_mut(|asked| {
        asked.resize(bytes, 0);
        asked.as_mut_ptr()
    })
}

/// Solves the scene that was written, with its mold in triangles or without; how many bytes the answer has.
#[unsafe(no_mangle)]
pub extern "C" fn solve(with_mold: bool) -> usize {
    let mold = if with_mold { Mold::Drawn } else { Mold::Known };
    let scene = ASKED.with_borrow(|asked| String::from_utf8_lossy(asked).into_owned());
    let text = answer(&scene, mold);
    TOLD.with_borrow_mut(|told| {
        text.text().clone_into(told);
        told.len()
    })
}

/// Where the answer is.
#[unsafe(no_mangle)]
pub extern "C" fn told() -> *const u8 {
    TOLD.with_borrow(|told| told.as_ptr())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An answer is as long as it is said to be, and a text that is no scene is refused.
    #[test]
    fn a_scene_without_keys_is_refused() {
        assert!(!room(0).is_null());
        let length = solve(true);
        assert!(!told().is_null());
        TOLD.with_borrow(|told| {
            assert_eq!(told.len(), length);
            assert!(told.starts_with("{\"refused\":\"`the scene` is empty"), "{told}");
        });
    }
}
