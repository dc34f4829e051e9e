//! Outlines as further edges of the image.
//!
//! Visibility is decided on the tessellation, which the true outline runs in and out of. So its points are moved outward
//! by a little more than that before (`lift`): its own facets are then beside it and cannot hide it. Where edges and
//! outlines lie when they are compared with their own faces is worked out in `own_lines`.

use super::facing::facing;
use super::grazing::Grazing;
use super::image::{Classes, Edge, Image, Outlined};
use super::own_lines::{self, Stretch};
use super::trace::Silhouette;
use crate::lines::View;
use hlr_brep::geometry::vector::{Vector, scaled, sub};
use hlr_visibility::scan::stretches::Beside;

/// How far points are moved, model units.
pub struct Lengths {
    /// Beyond the triangles that stand out at an outline, but at most so far in all.
    pub spare: f64,
    pub most: f64,
    /// Off a face before a line is compared with the triangles of that face.
    pub own: f64,
}

impl Lengths {
    /// How far a point is moved where triangles stand out by `rise`.
    pub fn lift(&self, rise: f64) -> f64 {
        (rise + self.spare).min(self.most)
    }
}

/// The image with these outlines. grazing: borders of faces that are seen nearly edge-on.
pub fn outlined(
    image: &Image,
    classes: &Classes,
    lines: &[Silhouette],
    grazing: &[Grazing],
    lengths: &Lengths,
) -> Outlined {
    let traced: usize = lines.iter().map(|line| line.points.len()).sum();
    // A stretch of an edge, or of an outline, may need a line off its face and one in its place.
    let stretches = traced + grazing.len();
    let (mut out, (groups, sheet, facing)) = rayon::join(
        || Outlined::of(image, traced + 4 * stretches, traced + 2 * stretches),
        || {
            let groups = groups(image);
            let facing =
                if image.convex { Vec::new() } else { facing(lines, &groups, image.closed, &image.view, lengths.most) };
            (groups, own_lines::sheets(image, classes), facing)
        },
    );
    let mut beyond = Vec::new();
    for (number, line) in (0..).zip(lines) {
        let part = image.first.partition_point(|&first| first <= line.face) as i32 - 1;
        let group = groups[line.face as usize];
        let closed = image.closed[group as usize];
        let side = if line.concave && !closed { -1.0 } else { 1.0 };
        let before = out.points.len() as i32;
        for ((point, normal), &rise) in line.points.iter().zip(&line.normals).zip(&line.rise) {
            let (outward, distance) = (scaled(normal, side), lengths.lift(rise));
            out.points.push(*point);
            out.lift.push(scaled(&outward, distance));
            // At least as far as from all other triangles: those of its own face may stand out by more.
            beyond.push(scaled(&outward, distance.max(lengths.own)));
        }
        for from in before..out.points.len() as i32 - 1 {
            let kind = classes.outline;
            out.push(Edge { ends: [from, from + 1], part, group, kind, hidden: line.concave && closed, number });
        }
        out.starts.push((out.edges.len() - image.edges.len()) as i32);
        out.part_of_outline.push(part);
        out.face_in_part.push(line.face - image.first[part as usize]);
    }
    let bounds = |g: &&Grazing| g.crossed.is_some() || classes.border[image.kind[g.edge as usize] as usize];
    let bare: Vec<&Grazing> = grazing.iter().filter(bounds).collect();
    // For one convex body culling alone decides: no edge needs its own faces.
    if !image.convex || !bare.is_empty() {
        let mut stretches: Vec<Stretch> = bare.into_iter().map(|g| of_border(image, g, lengths)).collect();
        let (first, points) = (image.edges.len(), image.points.len());
        // Outlines that their own body hides anyway need no own faces.
        let free = (first..out.edges.len()).filter(|&e| !out.hidden[e]);
        stretches.extend(free.map(|e| Stretch {
            edge: e as i32,
            range: [0.0, 1.0],
            face: lines[out.number[e] as usize].face,
            off: out.edges[e].map(|p| beyond[p as usize - points]),
            lift: [[0.0; 3]; 2],
            beside: Beside::Unknown as u8,
            dented: false,
            replaced: image.near[out.group[e] as usize] || facing.get(e - first) == Some(&true),
        }));
        own_lines::add(&mut out, image, classes, sheet, &stretches);
    }
    out
}

/// Per face its group: all triangles of a face are in one.
fn groups(image: &Image) -> Vec<i32> {
    let mut groups = vec![0; image.traced.len()];
    image.triangle_face.iter().zip(image.triangle_group).for_each(|(&face, &group)| groups[face as usize] = group);
    groups
}

/// A border of a face that is seen nearly edge-on, as it is compared with that face.
fn of_border(image: &Image, border: &Grazing, lengths: &Lengths) -> Stretch {
    let edge = border.edge as usize;
    let closed = match border.crossed {
        Some(pair) => pair.iter().all(|&t| image.closed[image.triangle_group[t as usize] as usize]),
        None => image.closed[image.group[edge] as usize],
    };
    let beside = if closed { border.beside } else { Beside::Unknown };
    // Only the outer side of a closed body is seen; of an open one, the side that faces the viewer.
    let side = if closed || border.front { 1.0 } else { -1.0 };
    // Beside the end of an outline the edge is moved like the outline: what touches the face there has facets too. It is
    // also moved toward the viewer: off its curved face it might lie in the plane of the other face.
    let turns = border.rise.filter(|rise| beside == Beside::Visible && rise.iter().all(|r| *r >= 0.0));
    let lift = turns.map_or([[0.0; 3]; 2], |rise| {
        [0, 1].map(|k| {
            let normal = scaled(&border.normals[k], lengths.lift(rise[k]));
            let toward = scaled(&toward(&image.view, &image.points[image.edges[edge][k] as usize]), lengths.spare);
            [0, 1, 2].map(|i| normal[i] + toward[i])
        })
    });
    Stretch {
        edge: border.edge as i32,
        range: border.range,
        face: border.face,
        off: border.normals.map(|normal| scaled(&normal, lengths.own * side)),
        lift,
        beside: beside as u8,
        dented: border.dented,
        replaced: false,
    }
}

/// The unit vector from a point toward the viewer.
fn toward(view: &View, point: &Vector) -> Vector {
    if !view.perspective {
        return view.away.map(|c| -c);
    }
    let way = sub(&view.origin, point);
    let length = (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]).sqrt();
    way.map(|c| c / length.max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles of one face, and an outline of two points across it.
    fn moved(rise: f64, lengths: &Lengths) -> (Vec<f64>, Vec<f64>) {
        let image = Image {
            points: &[[0.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]],
            edges: &[[0, 1]],
            offsets: &[0, 2],
            incident: &[0, 1],
            kind: &[0],
            part: &[0],
            group: &[0],
            curved: &[true],
            triangle_face: &[0, 0],
            triangle_group: &[0, 0],
            first: &[0],
            traced: &[true],
            closed: &[true],
            near: &[false],
            convex: false,
            view: View { origin: [0.0; 3], away: [0.0, 0.0, -1.0], perspective: false },
        };
        let (border, tangent) = ([true; 256], [false; 256]);
        let classes = Classes { border: &border, tangent: &tangent, outline: 2, interior: 3 };
        let line = Silhouette {
            face: 0,
            concave: false,
            points: vec![[0.0, 1.0, 0.0], [0.0, 2.0, 0.0]],
            normals: vec![[1.0, 0.0, 0.0]; 2],
            rise: vec![rise; 2],
            curve: None,
            source: -1,
        };
        let out = outlined(&image, &classes, &[line], &[], lengths);
        let far = |edge: i32| out.edges[edge as usize].map(|p| out.lift[p as usize][0]);
        assert_eq!(
            (&out.edges[1], out.kind[1], &out.own.edge[..], &out.own.face[..]),
            (&[4, 5], 2, &[1][..], &[0][..])
        );
        (far(1).to_vec(), far(out.own.off[0]).to_vec())
    }

    #[test]
    fn an_outline_is_moved_off_its_own_face_by_more_than_off_all_others_where_these_are_near() {
        let lengths = Lengths { spare: 0.25, most: 2.0, own: 1.0 };
        assert_eq!(moved(0.25, &lengths), (vec![0.5; 2], vec![1.0; 2]));
        assert_eq!(moved(1.25, &lengths), (vec![1.5; 2], vec![1.5; 2]));
        assert_eq!(moved(9.0, &lengths), (vec![2.0; 2], vec![2.0; 2]));
    }
}
