//! Contacts, pockets and forces with their full levers: section 18. Every force acts where the bodies touch, so that linear and
//! angular momentum and energy close.
//!
//! For the contact of a roller with ring g: D = X_j - x_g, rho = |D|, n = D/rho, t = n turned by +90 degrees; n and t are held
//! in the roller's frame (e_r, e_t).

mod forces;
mod motion;
mod pockets;

pub(super) use forces::forces;
pub(super) use motion::motion;
pub(crate) use pockets::stretch;
