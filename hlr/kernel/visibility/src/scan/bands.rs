//! Divides the image into horizontal bands, in which the searches for crossings and seeds run side by side.
//!
//! ```text
//!   band k:  y0 + k 2^shift <= y < y0 + (k + 1) 2^shift
//! ```

use hlr_exact::Point;

/// Most bands; more would gain nothing.
pub const MOST_BANDS: usize = 4096;

#[derive(Clone, Copy, Debug)]
pub struct Bands {
    pub y0: i64,
    pub shift: u32,
    pub count: usize,
}

impl Bands {
    /// Chooses a band height: low enough that few items share a band, high enough that an item is in about `spread`
    /// bands. as_many: as how many items each counts.
    pub fn choose(ranges: &[(i32, i32)], as_many: impl Fn(usize) -> usize, spread: f64) -> Bands {
        let Some(y0) = ranges.iter().map(|r| i64::from(r.0)).min() else {
            return Bands { y0: 0, shift: 31, count: 1 };
        };
        let y1 = ranges.iter().map(|r| i64::from(r.1)).max().unwrap_or(y0);
        let length = |(k, r): (usize, &(i32, i32))| (i64::from(r.1) - i64::from(r.0)) as f64 * as_many(k) as f64;
        let total: f64 = ranges.iter().enumerate().map(length).sum();
        let count: usize = (0..ranges.len()).map(&as_many).sum();
        let wanted = total / (spread * count as f64);
        let height = y1 - y0 + 1;
        let mut shift = 0u32;
        while ((1i64 << shift) as f64) < wanted || (height >> shift) as usize >= MOST_BANDS {
            shift += 1;
        }
        // A handful of items per band is enough: more bands would only cost their own overhead.
        while (height >> shift) as usize > count / 8 + 1 {
            shift += 1;
        }
        Bands { y0, shift, count: (height >> shift) as usize + 1 }
    }

    #[inline(always)]
    pub fn of(&self, y: i32) -> usize {
        let k = ((i64::from(y) - self.y0) >> self.shift).max(0) as usize;
        k.min(self.count - 1)
    }

    /// Lower and upper y of band k; the last band has no upper limit and the first no lower one.
    pub fn limits(&self, k: usize) -> (i64, i64) {
        let low = self.y0 + ((k as i64) << self.shift);
        (low, low + (1i64 << self.shift))
    }

    /// Items by band: (offsets, items), items ascending within each band.
    pub fn bucket(&self, ranges: &[(i32, i32)]) -> (Vec<u32>, Vec<u32>) {
        let mut offsets = vec![0u32; self.count + 1];
        for &(low, high) in ranges {
            for k in self.of(low)..=self.of(high) {
                offsets[k + 1] += 1;
            }
        }
        for k in 0..self.count {
            offsets[k + 1] += offsets[k];
        }
        let mut next = offsets.clone();
        let mut items = vec![0u32; offsets[self.count] as usize];
        for (i, &(low, high)) in ranges.iter().enumerate() {
            for k in self.of(low)..=self.of(high) {
                items[next[k] as usize] = i as u32;
                next[k] += 1;
            }
        }
        (offsets, items)
    }
}

/// An edge that is cut into bands.
#[derive(Clone, Copy, Debug)]
pub struct Slanted {
    /// Lower and upper end: x, y.
    low: (i32, i64),
    high: (i32, i64),
    /// x per y.
    slope: f64,
}

impl Slanted {
    #[inline]
    pub fn new(a: &Point, b: &Point) -> Slanted {
        let (low, high) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        let (low, high) = ((low[0], i64::from(low[1])), (high[0], i64::from(high[1])));
        Slanted { low, high, slope: (f64::from(high.0) - f64::from(low.0)) / (high.1 - low.1) as f64 }
    }

    /// Whether some of it lies between y0 and y1.
    #[inline]
    pub fn meets(&self, y0: i64, y1: i64) -> bool {
        self.low.1 <= y1 && self.high.1 >= y0
    }

    /// x range of the part between y0 and y1; conservative, never too small.
    #[inline]
    pub fn between(&self, y0: i64, y1: i64) -> (i32, i32) {
        let ((xlow, ylow), (xhigh, yhigh)) = (self.low, self.high);
        let (left, right) = (xlow.min(xhigh), xlow.max(xhigh));
        if (ylow >= y0 && yhigh <= y1) || left == right {
            return (left, right);
        }
        let at = |y: i64| f64::from(xlow) + (y - ylow) as f64 * self.slope;
        let start = if ylow < y0 { at(y0) } else { f64::from(xlow) };
        let end = if yhigh > y1 { at(y1) } else { f64::from(xhigh) };
        // The products are off by less than one unit; two are conservative.
        (left.max((start.min(end) - 2.0) as i32), right.min((start.max(end) + 2.0) as i32))
    }
}

/// x range of the part of a -> b between y0 and y1; conservative, never too small.
#[inline]
pub fn clipped_x(a: &Point, b: &Point, y0: i64, y1: i64) -> (i32, i32) {
    let (low, high) = y_range(a, b);
    if i64::from(low) >= y0 && i64::from(high) <= y1 {
        return (a[0].min(b[0]), a[0].max(b[0]));
    }
    Slanted::new(a, b).between(y0, y1)
}

/// Lower and upper y of an edge.
pub fn y_range(a: &Point, b: &Point) -> (i32, i32) {
    (a[1].min(b[1]), a[1].max(b[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_is_in_every_band_it_touches() {
        let ranges = [(0, 100), (50, 50), (99, 100), (-7, 3)];
        let bands = Bands::choose(&ranges, |_| 1, 0.1);
        let (offsets, items) = bands.bucket(&ranges);
        for (i, r) in ranges.iter().enumerate() {
            for y in r.0..=r.1 {
                let k = bands.of(y);
                let (low, high) = bands.limits(k);
                assert!(low <= i64::from(y) && i64::from(y) < high);
                let bucket = &items[offsets[k] as usize..offsets[k + 1] as usize];
                assert!(bucket.contains(&(i as u32)));
            }
        }
    }

    #[test]
    fn clipping_is_conservative() {
        let (a, b) = ([-1_000_000_000, -1_000_000_000, 0], [1_000_000_000, 999_999_999, 0]);
        let (left, right) = clipped_x(&a, &b, -10, 10);
        assert!(left <= -10 && right >= 10 && left > -20 && right < 20);
        assert_eq!(clipped_x(&[3, 0, 0], &[9, 0, 0], -5, 5), (3, 9));
    }
}
