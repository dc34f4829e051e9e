//! End points of lines. A line keeps its vertices at places where other lines end.

use rustc_hash::FxHashMap;

use super::Polyline;

/// The number of line ends at each point on paper.
pub struct Ends(FxHashMap<(u64, u64), u32>);

fn key(p: &[f64; 2]) -> (u64, u64) {
    let [x, y] = p.map(|c| (c + 0.0).to_bits());
    (x, y)
}

impl Ends {
    pub fn of(lines: &[Polyline]) -> Ends {
        let mut count = FxHashMap::default();
        for line in lines {
            for p in [&line.flat[0], &line.flat[line.flat.len() - 1]] {
                *count.entry(key(p)).or_insert(0) += 1;
            }
        }
        Ends(count)
    }

    /// Whether a line other than this one ends at a point.
    pub fn meet(&self, line: &Polyline, p: &[f64; 2]) -> bool {
        let own = [&line.flat[0], &line.flat[line.flat.len() - 1]].into_iter().filter(|e| key(e) == key(p)).count();
        self.0.get(&key(p)).is_some_and(|&n| n as usize > own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_own_ends_of_a_loop_are_not_those_of_another_line() {
        let line = |flat: Vec<[f64; 2]>| Polyline {
            visible: true,
            space: vec![[0.0; 3]; flat.len()],
            flat,
            ..Polyline::default()
        };
        let ring = line(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]]);
        let rib = line(vec![[5.0, 5.0], [1.0, 0.0]]);
        let ends = Ends::of(&[ring.clone(), rib]);
        assert!(!ends.meet(&ring, &[0.0, 0.0]) && !ends.meet(&ring, &[1.0, 1.0]));
        assert!(ends.meet(&ring, &[1.0, 0.0]));
    }
}
