//! Sequential probability ratio tests.
