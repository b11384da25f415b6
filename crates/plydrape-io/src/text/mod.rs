//! Results as tables for people, and times in words.

pub mod forecast;
pub mod start;
pub mod strategy;
pub mod table;
