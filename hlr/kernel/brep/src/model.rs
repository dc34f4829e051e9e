//! The model read from a dump: parts, and each underlying face and edge once, however often it is placed.

use rayon::prelude::*;

use crate::classes::{Classes, classes};
use crate::explore::{self, Part};
use crate::format::{Damaged, Dump, Kind, Locations, On, Orientation, Shape, Sub, SurfaceRecord};
use crate::geometry::curve::Curve;
use crate::geometry::moved_surface::moved;
use crate::geometry::surface::Surface;
use crate::part_topology::{PartTopology, part_topology};
use crate::shapes::{Edge, Face, OnSurface, Shapes, Use};

pub struct Model {
    pub locations: Locations,
    pub edges: Vec<Edge>,
    pub faces: Vec<Face>,
    pub parts: Vec<Part>,
    pub topology: Vec<PartTopology>,
    /// Classes by part and edge.
    pub classes: Vec<Vec<Classes>>,
    /// Curves in (u, v), as curves in space with z = 0.
    pub curves2: Vec<Option<Curve>>,
}

impl Model {
    /// Reads a model from a dump. The parts are the children of its root, a compound: all, or those with the numbers
    /// `chosen`.
    ///
    /// # Errors
    /// The bytes are damaged, the parts contain too many shapes, or a chosen child does not exist.
    pub fn read(bytes: &[u8], chosen: Option<&[u32]>) -> Result<Model, Damaged> {
        let dump = crate::format::read(bytes)?;
        let parts = explore::children(&dump, chosen)?;
        Model::of(dump, &parts)
    }

    /// The model of these parts, one or several shapes each.
    ///
    /// # Errors
    /// The parts contain too many shapes.
    pub fn of(mut dump: Dump, parts: &[Vec<Sub>]) -> Result<Model, Damaged> {
        let found = explore::explore(&mut dump, parts)?;
        let mut triangulations: Vec<_> = std::mem::take(&mut dump.triangulations).into_iter().map(Some).collect();
        let edges: Vec<Edge> = found.edges.iter().map(|&shape| edge(&mut dump, shape)).collect();
        let mut number = vec![None; dump.shapes.len()];
        (0..).zip(&found.edges).for_each(|(i, &shape)| number[shape as usize] = Some(i));
        let faces: Vec<Face> =
            found.faces.iter().map(|&shape| face(&mut dump, shape, &number, &edges, &mut triangulations)).collect();
        let Dump { mut locations, curves2, .. } = dump;
        let topology: Vec<PartTopology> =
            found.parts.iter().map(|part| part_topology(part, &faces, &edges, &mut locations)).collect();
        let mut model = Model { locations, edges, faces, parts: found.parts, topology, classes: Vec::new(), curves2 };
        model.classify();
        Ok(model)
    }

    /// Classifies the edges of all parts. Where the class changes along an edge, its polyline gets a corner.
    fn classify(&mut self) {
        let shapes = Shapes { edges: &self.edges, faces: &self.faces, curves2: &self.curves2 };
        let of_part = |part: &PartTopology| -> Vec<Classes> {
            (0..part.edges.len()).into_par_iter().map(|edge| classes(shapes, part, edge)).collect()
        };
        self.classes = self.topology.par_iter().map(of_part).collect();
        for (part, classes) in self.topology.iter().zip(&self.classes) {
            for (placed, classes) in part.edges.iter().zip(classes) {
                self.edges[placed.edge as usize].joints.extend(classes.more.iter().map(|(joint, _)| joint));
            }
        }
        for edge in &mut self.edges {
            edge.joints.sort_unstable_by(f64::total_cmp);
            edge.joints.dedup();
        }
    }
}

fn edge(dump: &mut Dump, shape: u32) -> Edge {
    let shape = &mut dump.shapes[shape as usize];
    let subs = std::mem::take(&mut shape.subs);
    let Kind::Edge { tolerance, degenerate, ref mut on, continuity, .. } = shape.kind else { unreachable!("an edge") };
    let on = std::mem::take(on);
    let mut found = Edge {
        curve: None,
        range: [0.0; 2],
        tolerance,
        degenerate,
        ends: [None; 2],
        end_points: [None; 2],
        // 0: nothing recorded, 1: C0, above: tangent.
        tangent: continuity > 1,
        on: Vec::with_capacity(on.len()),
        polygon: None,
        only_on: None,
        joints: Vec::new(),
    };
    for on in on {
        match on {
            On::Curve { curve, location, range } if found.curve.is_none() => {
                let location = dump.locations.written(location);
                found.curve = if location == 0 {
                    dump.curves[curve].clone()
                } else {
                    let matrix = dump.locations.matrix(location);
                    dump.curves[curve].as_ref().map(|curve| curve.moved(&matrix))
                };
                found.range = range;
            }
            On::Surface { curves, surface, location, range } => {
                let location = dump.locations.written(location);
                found.on.push(OnSurface { surface, location, curves, range });
            }
            On::Polygon { polygon, location } if found.polygon.is_none() => {
                let location = dump.locations.written(location);
                let matrix = dump.locations.matrix(location);
                let points = &dump.polygons[polygon];
                found.polygon = Some(points.iter().map(|p| crate::format::moved(&matrix, p)).collect());
            }
            _ => {}
        }
    }
    if found.curve.is_none() || !found.range.iter().all(|t| t.is_finite()) || found.range[0] >= found.range[1] {
        found.curve = None;
        found.range = found.on.first().map_or([0.0; 2], |on| on.range);
        if let (Some(on), false) = (found.on.first(), degenerate) {
            let matrix = dump.locations.matrix(on.location);
            found.only_on = dump.surfaces[on.surface]
                .as_ref()
                .and_then(|r| Surface::read(r.kind, &moved(r.kind, &r.data, &matrix)?))
                .map(|surface| (on.curves[0], surface));
        }
    }
    for sub in subs {
        let end = match sub.orientation {
            Orientation::Forward => 0,
            Orientation::Reversed => 1,
            _ => continue,
        };
        if found.ends[end].is_none() {
            let location = dump.locations.written(sub.location);
            let Kind::Vertex { point, .. } = dump.shapes[sub.shape as usize].kind else { continue };
            found.ends[end] = Some((sub.shape, location));
            found.end_points[end] = Some(crate::format::moved(&dump.locations.matrix(location), &point));
        }
    }
    found
}

fn face(
    dump: &mut Dump,
    shape: u32,
    number: &[Option<u32>],
    edges: &[Edge],
    triangulations: &mut [Option<crate::format::Triangulation>],
) -> Face {
    let shape = &mut dump.shapes[shape as usize];
    let subs = std::mem::take(&mut shape.subs);
    let Kind::Face { tolerance, surface, location, triangulation } = shape.kind else { unreachable!("a face") };
    let location = dump.locations.written(location);
    let record = if location == 0 {
        surface.and_then(|i| dump.surfaces[i].clone())
    } else {
        let matrix = dump.locations.matrix(location);
        let written = surface.and_then(|i| dump.surfaces[i].as_ref());
        written.and_then(|r| Some(SurfaceRecord { kind: r.kind, data: moved(r.kind, &r.data, &matrix)? }))
    };
    let read = record.as_ref().and_then(|r| Surface::read(r.kind, &r.data));
    let own = if surface.is_none() { triangulation.and_then(|i| triangulations[i].clone()) } else { None };
    let mut wires = Vec::with_capacity(subs.len());
    for wire in subs {
        let Shape { kind: Kind::Wire, subs: inner } = &dump.shapes[wire.shape as usize] else { continue };
        let outer = dump.locations.written(wire.location);
        let mut uses = Vec::with_capacity(inner.len());
        for &sub in inner {
            let Some(edge) = number[sub.shape as usize] else { continue };
            let within = dump.locations.written(sub.location);
            let stands = dump.locations.product(outer, within);
            let orientation = wire.orientation.compose(sub.orientation);
            let wanted = dump.locations.quotient(stands, location);
            let on = &edges[edge as usize].on;
            let of_surface = |on: &&OnSurface| Some(on.surface) == surface;
            let fits = on.iter().filter(of_surface).find(|on| on.location == wanted);
            let curve2 = fits.or_else(|| on.iter().find(of_surface)).map(|on| {
                let reversed = orientation == Orientation::Reversed;
                (on.curves[usize::from(reversed)], on.range)
            });
            let curve2 = curve2.filter(|(_, range)| range.iter().all(|t| t.is_finite()));
            let place = (stands != 0).then(|| dump.locations.matrix(stands));
            let ends = edges[edge as usize].ends(edge);
            let ends = ends.map(|(shape, location)| (shape, dump.locations.product(stands, location)));
            uses.push(Use { edge, location: stands, place, orientation, ends, curve2 });
        }
        wires.push(uses);
    }
    Face { record, surface: read, tolerance, wires, own }
}
