//! Results as tables for people, and times in words.

pub mod forecast;
pub mod foreseen;
pub mod strategy;
pub mod table;
