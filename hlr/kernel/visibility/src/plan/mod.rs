//! What a view calls for, before the pass: which edges have a role, and how near counts as touching.
//!
//! ```text
//! `contact`   contact tolerances of groups in a view, and which groups come near one another
//! `roles`     which edges are drawn, and what the pass is told of all
//! ```

pub mod contact;
pub mod roles;

pub type Vec3 = [f64; 3];
