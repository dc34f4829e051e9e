//! The polygon table: for each polygon its plane (`Facet`), and whether the scan is inside it.
//!
//! Crossing an edge toggles a flag under the even-odd rule; the non-zero rule needs a counter. With a flag a polygon
//! may be entered several times in one row.
//!
//! Depth is noted where a polygon is entered, from the record of the edge, beside the depths of the other polygons
//! entered: values that are compared lie together in memory. Along the row it changes by -A / C per pixel.

use super::scene::Rule;

const OUT: u32 = u32::MAX;

pub struct PolygonTable {
    rule: Rule,
    winding: Vec<i32>,
    /// Index of each polygon in `inside`.
    place: Vec<u32>,
    /// The polygons that contain the current position of the scan, in no order.
    pub inside: Vec<u32>,
    /// Their depths, where these are needed.
    depths: Vec<Along>,
}

/// Depth along a row, from the column in which a polygon was entered.
#[derive(Clone, Copy, Debug)]
pub struct Along {
    pub column: i64,
    pub depth: f64,
    pub right: f64,
}

impl Along {
    pub const UNKNOWN: Along = Along { column: 0, depth: f64::NAN, right: 0.0 };

    /// Within half of `NEAR_TIE`, as `Facet::depth_at`.
    #[inline(always)]
    pub fn at(&self, column: i64) -> f64 {
        self.depth + self.right * (column - self.column) as f64
    }
}

/// Effect of crossing an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toggle {
    Entered,
    Left,
    Nothing,
}

impl PolygonTable {
    pub fn new(rule: Rule, facets: usize) -> PolygonTable {
        PolygonTable {
            rule,
            winding: vec![0; facets],
            place: vec![OUT; facets],
            inside: Vec::new(),
            depths: Vec::new(),
        }
    }

    #[inline]
    pub fn cross(&mut self, facet: u32, winding: i32) -> Toggle {
        self.cross_at(facet, winding, || Along::UNKNOWN)
    }

    /// Depth of the polygon at index k of `inside`.
    #[inline(always)]
    pub fn depth(&self, k: usize, column: i64) -> f64 {
        self.depths[k].at(column)
    }

    /// `along` is called where the polygon is entered.
    #[inline]
    pub fn cross_at(&mut self, facet: u32, winding: i32, along: impl FnOnce() -> Along) -> Toggle {
        let f = facet as usize;
        let before = self.rule.inside(self.winding[f]);
        self.winding[f] += winding;
        match (before, self.rule.inside(self.winding[f])) {
            (false, true) => {
                self.place[f] = self.inside.len() as u32;
                self.inside.push(facet);
                self.depths.push(along());
                Toggle::Entered
            }
            (true, false) => {
                let at = self.place[f] as usize;
                self.inside.swap_remove(at);
                self.depths.swap_remove(at);
                if let Some(&moved) = self.inside.get(at) {
                    self.place[moved as usize] = at as u32;
                }
                self.place[f] = OUT;
                Toggle::Left
            }
            _ => Toggle::Nothing,
        }
    }

    pub fn bytes(&self) -> usize {
        use super::statistics::bytes_of;
        bytes_of(&self.winding) + bytes_of(&self.place) + bytes_of(&self.inside) + bytes_of(&self.depths)
    }
}
