//! Places on paper, looked up by the box that they lie in.
//!
//! ```text
//!    row 2  |      o    o |           They are sorted from left to right, all of them and again row by row. The rows are
//!    row 1  | o  +-----+  |           searched where many places lie above and below the box: their number is that of
//!    row 0  |   o|_o___|  |  o        one column, and grows with the number of all.
//! ```

use super::plane::Vec2;

/// Places above and below a box, for each of its rows, that take no longer to look through than to search the rows.
const FEW: usize = 16;

pub struct Places {
    /// From left to right.
    at: Vec<Vec2>,
    low: f64,
    height: f64,
    /// Row r has the places members[offsets[r]..offsets[r + 1]], from left to right.
    offsets: Vec<u32>,
    members: Vec<u32>,
}

impl Places {
    /// at: from left to right, in the order of `f64::total_cmp`.
    pub fn of(at: Vec<Vec2>) -> Places {
        let (low, high) = at.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p[1]), b.max(p[1])));
        let rows = (at.len() as f64).sqrt().ceil().max(1.0);
        let mut out =
            Places { at, low, height: (high - low) / rows, offsets: vec![0; rows as usize + 1], members: vec![] };
        let row_of: Vec<usize> = out.at.iter().map(|p| out.row(p[1])).collect();
        row_of.iter().for_each(|&row| out.offsets[row + 1] += 1);
        for row in 1..out.offsets.len() {
            out.offsets[row] += out.offsets[row - 1];
        }
        let mut next = out.offsets.clone();
        out.members = vec![0; out.at.len()];
        for (number, &row) in row_of.iter().enumerate() {
            out.members[next[row] as usize] = number as u32;
            next[row] += 1;
        }
        out
    }

    /// Calls `visit` with the number of each place in a box, its borders included, in no particular order, until one
    /// answers true. True where one did.
    pub fn any(&self, [low, high]: [Vec2; 2], mut visit: impl FnMut(usize) -> bool) -> bool {
        if self.at.is_empty() || low[0] > high[0] || low[1] > high[1] {
            return false;
        }
        let from = self.at.partition_point(|p| p[0] < low[0]);
        let to = from + self.at[from..].partition_point(|p| p[0] <= high[0]);
        let inside = |k: usize| self.at[k][1] >= low[1] && self.at[k][1] <= high[1];
        let rows = self.row(low[1])..=self.row(high[1]);
        if to - from <= FEW * (rows.end() - rows.start() + 1) {
            return (from..to).any(|k| inside(k) && visit(k));
        }
        for row in rows {
            let members = &self.members[self.offsets[row] as usize..self.offsets[row + 1] as usize];
            let first = members.partition_point(|&k| (k as usize) < from);
            let here = members[first..].iter().map(|&k| k as usize).take_while(|&k| k < to);
            if here.into_iter().any(|k| inside(k) && visit(k)) {
                return true;
            }
        }
        false
    }

    /// The numbers of the places in a box, its borders included, in no particular order.
    pub fn within(&self, around: [Vec2; 2]) -> Vec<usize> {
        let mut found = Vec::new();
        self.any(around, |k| {
            found.push(k);
            false
        });
        found
    }

    /// The row of a coordinate. What is no number lies in the first.
    fn row(&self, y: f64) -> usize {
        (((y - self.low) / self.height) as usize).min(self.offsets.len() - 2)
    }
}

/// The box that reaches so far around a point.
pub fn around(p: &Vec2, reach: f64) -> [Vec2; 2] {
    [p.map(|c| c - reach), p.map(|c| c + reach)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Scattered by a congruential generator, from left to right.
    fn scattered(count: usize, size: Vec2) -> Vec<Vec2> {
        let mut state = 3u32;
        let mut next = |size: f64| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            size * f64::from(state >> 8) / f64::from(1 << 24)
        };
        let mut all: Vec<Vec2> = (0..count).map(|_| size.map(&mut next)).collect();
        all.sort_by(|a, b| a[0].total_cmp(&b[0]));
        all
    }

    #[test]
    fn those_in_a_box_are_found_and_no_others() {
        for size in [[100.0, 80.0], [1.0, 300.0], [300.0, 0.0]] {
            for count in [0, 1, 5, 3000] {
                let at = scattered(count, size);
                let places = Places::of(at.clone());
                for middle in scattered(50, size) {
                    for reach in [[3.0, 1.0], [0.4, 60.0], [500.0, 2.0], [0.0, 0.0]] {
                        let [low, high] = [-1.0, 1.0].map(|sign| [0, 1].map(|k| middle[k] + sign * reach[k]));
                        let inside = |p: &Vec2| (0..2).all(|k| p[k] >= low[k] && p[k] <= high[k]);
                        let wanted: Vec<usize> = (0..count).filter(|&k| inside(&at[k])).collect();
                        let mut found = places.within([low, high]);
                        found.sort_unstable();
                        assert_eq!(found, wanted);
                        assert_eq!(places.any([low, high], |k| k % 7 == 3), wanted.iter().any(|k| k % 7 == 3));
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_no_number_is_in_no_box() {
        let places = Places::of(vec![[0.0, 1.0], [1.0, f64::NAN], [2.0, f64::INFINITY], [f64::NAN, 1.0]]);
        assert_eq!(places.within(around(&[1.0, 1.0], 5.0)), [0]);
    }

    #[test]
    fn a_column_of_many_is_not_looked_through() {
        let at: Vec<Vec2> = (0..1 << 16).map(|k| [0.0, f64::from(k)]).collect();
        let places = Places::of(at);
        let rows = places.offsets.windows(2).map(|w| w[1] - w[0]).max();
        assert!(rows <= Some(257), "{rows:?}");
        let mut found = places.within(around(&[0.0, 1000.0], 1.5));
        found.sort_unstable();
        assert_eq!(found, [999, 1000, 1001]);
    }
}
