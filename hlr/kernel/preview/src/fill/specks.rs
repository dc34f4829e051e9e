//! Merges pieces of a map that are too small to be visible into a neighbour.

/// `map`: row by row, 0 for nothing. A connected piece of fewer than `least` places goes to the largest of its most
/// `alike` neighbours; to nothing only where there is no other neighbour.
pub fn merge(map: &mut [u32], [width, height]: [usize; 2], least: usize, alike: impl Fn(u32, u32) -> u32) {
    let piece = pieces(map, width, height);
    let count = piece.iter().max().map_or(0, |&m| m as usize + 1);
    let (mut size, mut value) = (vec![0usize; count], vec![0u32; count]);
    for (p, &v) in piece.iter().zip(map.iter()) {
        size[*p as usize] += 1;
        value[*p as usize] = v;
    }
    let small = |p: u32, size: &[usize]| size[p as usize] < least;
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    let mut meet = |a: u32, b: u32| {
        if a != b {
            if small(a, &size) {
                pairs.push([a, b]);
            }
            if small(b, &size) {
                pairs.push([b, a]);
            }
        }
    };
    for y in 0..height {
        for x in 0..width {
            let here = piece[y * width + x];
            if x + 1 < width {
                meet(here, piece[y * width + x + 1]);
            }
            if y + 1 < height {
                meet(here, piece[(y + 1) * width + x]);
            }
        }
    }
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

/// Row by row the number of the piece: adjacent places of one value, across or down, are one piece.
fn pieces(map: &[u32], width: usize, height: usize) -> Vec<u32> {
    let mut out = vec![0u32; map.len()];
    let mut owner: Vec<u32> = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let at = y * width + x;
            let left = (x > 0 && map[at - 1] == map[at]).then(|| out[at - 1]);
            let above = (y > 0 && map[at - width] == map[at]).then(|| out[at - width]);
            out[at] = match (left, above) {
                (Some(l), Some(a)) => {
                    let (l, a) = (root(&mut owner, l), root(&mut owner, a));
                    owner[l.max(a) as usize] = l.min(a);
                    l.min(a)
                }
                (Some(one), None) | (None, Some(one)) => one,
                (None, None) => {
                    owner.push(owner.len() as u32);
                    owner.len() as u32 - 1
                }
            };
        }
    }
    // Numbers pieces consecutively.
    let mut number = vec![u32::MAX; owner.len()];
    let mut next = 0;
    for p in &mut out {
        let r = root(&mut owner, *p) as usize;
        if number[r] == u32::MAX {
            number[r] = next;
            next += 1;
        }
        *p = number[r];
    }
    out
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

    #[test]
    fn a_speck_goes_to_the_largest_beside_it_and_not_to_nothing() {
        let mut map = vec![1, 1, 1, 0, 1, 2, 1, 0, 1, 1, 3, 0];
        merge(&mut map, [4, 3], 2, |_, _| 0);
        assert_eq!(map, [1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0]);
    }

    #[test]
    fn what_stands_alone_stays() {
        let mut map = vec![0, 0, 0, 0, 5, 0, 0, 0, 0];
        merge(&mut map, [3, 3], 4, |_, _| 0);
        assert_eq!(map[4], 5);
    }
}
