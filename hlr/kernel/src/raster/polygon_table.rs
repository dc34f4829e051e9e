//! The polygon table: for each polygon its plane (`Facet`), and whether the scan is inside it.
//!
//! Crossing an edge toggles a flag under the even-odd rule; the non-zero rule needs a counter. With it a polygon may be
//! entered several times in one row.

use super::scene::Rule;

const OUT: u32 = u32::MAX;

pub struct PolygonTable {
    rule: Rule,
    winding: Vec<i32>,
    /// Where each polygon stands in `inside`.
    place: Vec<u32>,
    /// The polygons that the scan is in, in no order.
    pub inside: Vec<u32>,
}

/// What crossing an edge meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toggle {
    Entered,
    Left,
    Nothing,
}

impl PolygonTable {
    pub fn new(rule: Rule, facets: usize) -> PolygonTable {
        PolygonTable { rule, winding: vec![0; facets], place: vec![OUT; facets], inside: Vec::new() }
    }

    #[inline]
    pub fn cross(&mut self, facet: u32, winding: i32) -> Toggle {
        let f = facet as usize;
        let before = self.rule.inside(self.winding[f]);
        self.winding[f] += winding;
        match (before, self.rule.inside(self.winding[f])) {
            (false, true) => {
                self.place[f] = self.inside.len() as u32;
                self.inside.push(facet);
                Toggle::Entered
            }
            (true, false) => {
                let at = self.place[f] as usize;
                self.inside.swap_remove(at);
                if let Some(&moved) = self.inside.get(at) {
                    self.place[moved as usize] = at as u32;
                }
                self.place[f] = OUT;
                Toggle::Left
            }
            _ => Toggle::Nothing,
        }
    }

    pub fn is_in(&self, facet: u32) -> bool {
        self.place[facet as usize] != OUT
    }

    pub fn bytes(&self) -> usize {
        use super::statistics::bytes_of;
        bytes_of(&self.winding) + bytes_of(&self.place) + bytes_of(&self.inside)
    }
}
