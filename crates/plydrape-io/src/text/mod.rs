//! Results as tables for people.

pub mod strategy;
pub mod table;
