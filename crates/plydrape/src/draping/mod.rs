//! draping
