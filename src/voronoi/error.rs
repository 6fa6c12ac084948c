//! What is not a diagram's input.

use core::fmt;

use glam::DVec3;

/// Why sites or a pole were refused.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VoronoiError {
    /// There is no site: nobody owns the sphere.
    NoSites,
    /// There are more sites than the 32-bit ids of a diagram can name.
    TooManySites {
        /// Number of sites given.
        len: usize,
    },
    /// A component of a site is NaN or infinite.
    NotFinite {
        /// Index of the site.
        index: usize,
        /// The site.
        site: DVec3,
    },
    /// A site is the zero vector, which has no direction.
    ZeroSite {
        /// Index of the site.
        index: usize,
    },
    /// A component of the pole is NaN or infinite.
    PoleNotFinite {
        /// The pole.
        pole: DVec3,
    },
    /// The pole is the zero vector, which has no direction.
    ZeroPole,
    /// Exact decisions contradicted each other at a site: a fault of this crate, which no input should bring about.
    Inconsistent {
        /// Index of the site.
        index: usize,
    },
}

impl fmt::Display for VoronoiError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSites => write!(f, "a diagram needs at least one site"),
            Self::TooManySites { len } => write!(f, "{len} sites are more than 32-bit ids can name"),
            Self::NotFinite { index, site } => write!(f, "site {index} is not finite: {site}"),
            Self::ZeroSite { index } => write!(f, "site {index} is the zero vector, which has no direction"),
            Self::PoleNotFinite { pole } => write!(f, "the pole is not finite: {pole}"),
            Self::ZeroPole => write!(f, "the pole is the zero vector, which has no direction"),
            Self::Inconsistent { index } => {
                write!(f, "no facet faces site {index}: a fault of the construction itself")
            }
        }
    }
}

impl core::error::Error for VoronoiError {}
