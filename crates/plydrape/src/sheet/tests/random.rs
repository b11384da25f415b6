//! Random sheets: whatever is asked of it, a sheet answers with numbers and an honest status.
