//! Gives lines of one edge that ended in one point a common end on their curve, equal to the last bit: a closed curve
//! evaluated one period later rounds differently.

use super::Drawn;
use super::arc::grow;
use super::plane::{length, minus};
use super::route::Route;
use hlr_accuracy::CURVE_SHARED_END;

/// Moves all ends that were one point to the first of them.
pub fn share_ends(routes: &[Route], drawn: &mut [Option<Drawn>], accuracy: f64) {
    let mut ends: Vec<(i32, [u64; 2], usize, usize)> = Vec::new();
    for (i, route) in routes.iter().enumerate().filter(|(i, r)| drawn[*i].is_some() && r.flat.len() > 1) {
        for end in [0, 1] {
            let at = route.flat[end * (route.flat.len() - 1)];
            ends.push((route.chain, at.map(f64::to_bits), i, end));
        }
    }
    ends.sort_unstable();
    for meeting in ends.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (_, _, i, end) = meeting[0];
        let Some((flat, space)) = drawn[i].as_ref().map(|d| (d.flat[end], d.space[end])) else { continue };
        for &(_, _, j, other) in &meeting[1..] {
            let Some(line) = drawn[j].as_mut() else { continue };
            if length(&minus(&line.flat[other], &flat)) <= CURVE_SHARED_END * accuracy {
                line.end_in(other, flat, space);
            }
        }
    }
}

impl Drawn {
    fn end_in(&mut self, end: usize, flat: [f64; 2], space: [f64; 3]) {
        (self.flat[end], self.space[end]) = (flat, space);
        if let super::Form::Chain(chain) = &mut self.form {
            let last = chain.points.len() - 1;
            chain.points[end * last] = flat;
        }
        grow(&mut self.bounds, &flat);
    }
}

#[cfg(test)]
mod tests {
    use super::super::Form;
    use super::super::route::Border;
    use super::*;

    #[test]
    fn what_was_one_point_is_one_again_and_what_was_moved_stays() {
        let (seen, hidden) = ([[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [3.0, 0.0]]);
        let deep = [[0.0; 3]; 2];
        let route = |visible, flat| {
            let border = Border::Edge;
            Route { chain: 7, visible, left_out: [false; 2], border, flat, space: &deep, curve: None, bulge: 0.0 }
        };
        let routes = [route(true, &seen[..]), route(false, &hidden[..])];
        let line = |flat: [[f64; 2]; 2]| {
            let space = flat.map(|p| [p[0], p[1], 0.0]);
            Some(Drawn { form: Form::Straight, range: [0.0, 1.0], flat, space, bounds: flat })
        };
        let off = 0.3 + 1e-16 + 0.1;
        let mut drawn = [line([[0.0, 0.0], [0.4, 0.0]]), line([[off, 0.0], [3.0, 0.0]])];
        assert_ne!(off, 0.4);
        share_ends(&routes, &mut drawn, 0.05);
        let ends = drawn.each_ref().map(|d| d.as_ref().unwrap());
        assert_eq!((ends[0].flat[1], ends[0].space[1]), (ends[1].flat[0], ends[1].space[0]));
        let mut drawn = [line([[0.0, 0.0], [0.4, 0.0]]), line([[0.5, 0.0], [3.0, 0.0]])];
        share_ends(&routes, &mut drawn, 0.05);
        assert_eq!(drawn[1].as_ref().unwrap().flat[0], [0.5, 0.0]);
    }
}
