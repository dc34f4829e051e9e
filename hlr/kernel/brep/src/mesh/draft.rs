//! A mesh that is not yet proved to fill the loops of its face.

use super::gap::Corner;
use super::outline::Outline;

/// Triangles of a face before their proof (`check`).
pub struct Draft {
    pub outline: Outline,
    /// The points of the outline, then the inner points.
    pub corners: Vec<Corner>,
    pub triangles: Vec<[u32; 3]>,
    /// For each point of the outline the point that the triangles use in its place.
    pub stand_in: Vec<u32>,
    pub error: f64,
    /// The surface is torn where the error exceeds the deflection.
    pub torn: bool,
    /// Whether the error exceeds the deflection because the border is off the surface.
    pub stalled: bool,
    /// Chords, each by its first point in the outline, that meet a triangle which exceeds the deflection.
    pub coarse: Vec<u32>,
    /// The corners' places in the chart in which the triangles were made, if it is bent.
    pub bent_chart: Option<Vec<[f64; 2]>>,
    /// Numbers of the loops that run the wrong way, once known.
    pub turned: Vec<usize>,
}
