//! The frame buffer of facet numbers that all methods fill, and an optional trace of the order of writes.

use super::screen::NONE;
use super::statistics::Statistics;

/// A run of pixels [from, to) of a row, written with one facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Write {
    pub row: u32,
    pub from: u32,
    pub to: u32,
    pub facet: u32,
}

/// How Warnock's subdivision finished with an area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// (a) all polygons are disjoint.
    Disjoint,
    /// (b) one is left, intersecting or contained.
    Single,
    /// (c) one surrounding polygon and no other.
    Surrounded,
    /// (d) a surrounding polygon in front of all others.
    InFront,
    /// A single pixel, decided at its centre.
    Pixel,
    Quartered,
}

/// One area of Warnock's subdivision: columns and rows, end exclusive; number of halvings; number of polygons in its
/// list, and of those passed over; what is visible in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Visit {
    pub columns: [i32; 2],
    pub rows: [i32; 2],
    pub level: u32,
    pub polygons: u32,
    pub passed: u32,
    pub ending: Ending,
    pub facet: u32,
}

pub struct Canvas {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<u32>,
    pub trace: Option<Vec<Write>>,
    /// Areas in the order of their visits; only with a trace.
    pub visits: Vec<Visit>,
}

impl Canvas {
    pub fn new(width: i64, height: i64, traced: bool) -> Canvas {
        let (width, height) = (width as usize, height as usize);
        Canvas { width, height, pixels: vec![NONE; width * height], trace: traced.then(Vec::new), visits: Vec::new() }
    }

    #[inline(always)]
    pub fn at(&self, column: i64, row: i64) -> u32 {
        self.pixels[row as usize * self.width + column as usize]
    }

    /// Writes pixels [from, to) of a row.
    #[inline(always)]
    pub fn write(&mut self, row: i64, from: i64, to: i64, facet: u32, statistics: &mut Statistics) {
        let start = row as usize * self.width;
        self.pixels[start + from as usize..start + to as usize].fill(facet);
        statistics.written += (to - from) as u64;
        if let Some(trace) = &mut self.trace {
            match trace.last_mut() {
                // Consecutive writes of one facet in a row count as one.
                Some(last) if last.facet == facet && i64::from(last.row) == row && i64::from(last.to) == from => {
                    last.to = to as u32;
                }
                _ => trace.push(Write { row: row as u32, from: from as u32, to: to as u32, facet }),
            }
        }
    }

    pub fn visited(&mut self, visit: impl FnOnce() -> Visit) {
        if self.trace.is_some() {
            self.visits.push(visit());
        }
    }

    pub fn bytes(&self) -> usize {
        super::statistics::bytes_of(&self.pixels)
    }
}
