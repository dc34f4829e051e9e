//! Divides triangles whose sides have got additional corners.

use std::collections::HashMap;

use super::border::Border;
use super::seams::Seams;

/// Returns all triangles, and for each the given triangle that it is a piece of. Orientations are kept.
pub fn split(triangles: &[[i32; 3]], borders: &[Border], seams: &Seams) -> (Vec<[i32; 3]>, Vec<i32>) {
    let to = |v: i32| seams.moved.get(&(v as u32)).map_or(v, |&n| n as i32);
    // Per triangle with a longer side: for each of its three sides what lies on it, in the triangle's direction.
    let mut longer: HashMap<u32, [Vec<i32>; 3]> = HashMap::new();
    for (border, inserted) in borders.iter().zip(&seams.inserted) {
        if !inserted.is_empty() {
            let corners = triangles[border.triangle as usize];
            let side = (0..3).find(|&k| corners[k] as u32 == border.ends[0]).unwrap_or(0);
            longer.entry(border.triangle).or_default()[side] = inserted.iter().map(|&n| n as i32).collect();
        }
    }
    let (mut out, mut origin) = (Vec::with_capacity(triangles.len()), Vec::with_capacity(triangles.len()));
    for (t, corners) in triangles.iter().enumerate() {
        let before = out.len();
        match longer.get(&(t as u32)) {
            None => out.push(corners.map(to)),
            Some(sides) => cut(corners.map(to), [&sides[0], &sides[1], &sides[2]], &mut out),
        }
        origin.extend(std::iter::repeat_n(t as i32, out.len() - before));
    }
    (out, origin)
}

/// Cuts a triangle at the middle corner of the side that has most additional corners, until no side has any.
fn cut([a, b, c]: [i32; 3], [ab, bc, ca]: [&[i32]; 3], out: &mut Vec<[i32; 3]>) {
    if ab.len() < bc.len().max(ca.len()) {
        return cut([b, c, a], [bc, ca, ab], out);
    }
    let middle = ab.len() / 2;
    let Some(&v) = ab.get(middle) else {
        out.push([a, b, c]);
        return;
    };
    cut([a, v, c], [&ab[..middle], &[], ca], out);
    cut([v, b, c], [&ab[middle + 1..], bc, &[]], out);
}
