//! A number over time: whether and when it changed, how fast it grows, and when it reaches a limit at that rate.
//!
//! Values scatter from record to record more than each one's interval says, and they wander: a machine is warmer on one day than on
//! another. The model is therefore a level of pieces plus an autoregressive scatter of first order, whose correlation from record to
//! record is estimated with the level (`fit.rs`). A change is a step, or the onset of growth: a straight line in time, of a logarithm
//! exponential growth. The largest gain of likelihood over all places and both kinds is held against the same gain of simulated scatter
//! without a change (a parametric bootstrap of the sup-F test of D. W. K. Andrews, Econometrica 61 (1993) 821), with the correlation
//! corrected for its bias (F. H. C. Marriott, J. A. Pope, Biometrika 41 (1954) 390); where one is significant, the parts before and behind it are
//! tested likewise (binary segmentation). Intervals are profile likelihoods over place and correlation; that of the place by the
//! threshold of B. E. Hansen, Econometrica 68 (2000) 575.

mod change;
mod course;
mod fit;
mod profile;
mod reach;

pub use change::{Change, FEWEST, Outcome, changes};
pub use course::Course;
pub use fit::Kind;
pub use reach::Reach;
