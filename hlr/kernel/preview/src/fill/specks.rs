//! Merges pieces of a map that are too small to be visible into a neighbour.

use super::runs::Runs;

/// `map`: the value of each run, 0 for nothing. A connected piece of fewer than `least` places goes to the largest of
/// its most `alike` neighbours; to nothing only where there is no other neighbour.
pub fn merge(runs: &Runs, map: &mut [u32], least: usize, alike: impl Fn(u32, u32) -> u32) {
    let piece = pieces(runs, map);
    let count = piece.iter().max().map_or(0, |&m| m as usize + 1);
    let (mut size, mut value) = (vec![0usize; count], vec![0u32; count]);
    for (k, (&p, &v)) in piece.iter().zip(map.iter()).enumerate() {
        size[p as usize] += runs.places(k).len();
        value[p as usize] = v;
    }
    let small = |p: u32| size[p as usize] < least;
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    let mut meet = |a: usize, b: usize| {
        let (a, b) = (piece[a], piece[b]);
        if a != b {
            if small(a) {
                pairs.push([a, b]);
            }
            if small(b) {
                pairs.push([b, a]);
            }
        }
    };
    runs.touching(&mut meet);
    pairs.sort_unstable();
    pairs.dedup();
    let mut of: Vec<&[[u32; 2]]> = pairs.chunk_by(|a, b| a[0] == b[0]).collect();
    of.sort_by_key(|pairs| (size[pairs[0][0] as usize], pairs[0][0]));
    let mut owner: Vec<u32> = (0..count as u32).collect();
    for pairs in of {
        let own = root(&mut owner, pairs[0][0]);
        if size[own as usize] >= least {
            continue; // this piece has grown
        }
        let mut best: Option<((u32, bool, usize), u32)> = None;
        for &[_, beside] in pairs {
            let beside = root(&mut owner, beside);
            let (a, b) = (value[own as usize], value[beside as usize]);
            let rank = (alike(a, b), b != 0, size[beside as usize]);
            if beside != own && best.is_none_or(|(r, _)| rank > r) {
                best = Some((rank, beside));
            }
        }
        // A piece that has only nothing around it stays, however small.
        if let Some((rank, beside)) = best
            && rank.1
        {
            owner[own as usize] = beside;
            size[beside as usize] += size[own as usize];
        }
    }
    for (v, &p) in map.iter_mut().zip(&piece) {
        *v = value[root(&mut owner, p) as usize];
    }
}

/// Per run the number of its piece: touching runs of one value are one piece.
fn pieces(runs: &Runs, map: &[u32]) -> Vec<u32> {
    let mut owner: Vec<u32> = (0..map.len() as u32).collect();
    let mut join = |a: usize, b: usize| {
        if map[a] == map[b] {
            let (a, b) = (root(&mut owner, a as u32), root(&mut owner, b as u32));
            owner[a.max(b) as usize] = a.min(b);
        }
    };
    runs.touching(&mut join);
    // Numbers pieces consecutively.
    let mut number = vec![u32::MAX; owner.len()];
    let mut next = 0;
    let numbered = |k: u32| {
        let r = root(&mut owner, k) as usize;
        if number[r] == u32::MAX {
            number[r] = next;
            next += 1;
        }
        number[r]
    };
    (0..map.len() as u32).map(numbered).collect()
}

fn root(owner: &mut [u32], mut p: u32) -> u32 {
    while owner[p as usize] != p {
        owner[p as usize] = owner[owner[p as usize] as usize];
        p = owner[p as usize];
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;

    fn merged(map: &[u32], width: usize, least: usize) -> Vec<u32> {
        let runs = Runs::new(map, width, u32::eq);
        let mut values: Vec<u32> = (0..runs.count()).map(|k| map[runs.places(k).start]).collect();
        merge(&runs, &mut values, least, |_, _| 0);
        (0..runs.count()).flat_map(|k| vec![values[k]; runs.places(k).len()]).collect()
    }

    #[test]
    fn a_speck_goes_to_the_largest_beside_it_and_not_to_nothing() {
        let map = [1, 1, 1, 0, 1, 2, 1, 0, 1, 1, 3, 0];
        assert_eq!(merged(&map, 4, 2), [1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0]);
    }

    #[test]
    fn what_stands_alone_stays() {
        assert_eq!(merged(&[0, 0, 0, 0, 5, 0, 0, 0, 0], 3, 4)[4], 5);
    }

    #[test]
    fn runs_around_a_hole_are_one_piece() {
        let map = [1, 1, 1, 1, 2, 1, 1, 1, 1];
        assert_eq!(pieces(&Runs::new(&map, 3, u32::eq), &[1, 1, 2, 1, 1]), [0, 0, 1, 0, 0]);
    }
}
