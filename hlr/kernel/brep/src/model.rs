//! The model read from a dump: parts, and each underlying face and edge once, however often it is placed.

use rayon::prelude::*;

use crate::classes::{Classes, classes};
use crate::copies::mark_copies;
use crate::explore::{self, Part};
use crate::folded::folded;
use crate::format::{Damaged, Dump, Kind, Locations, On, Orientation, Shape, Sub, SurfaceRecord};
use crate::geometry::curve::Curve;
use crate::geometry::moved_surface::moved;
use crate::geometry::surface::Surface;
use crate::part_topology::{PartTopology, part_topology};
use crate::shapes::{Edge, Face, OnSurface, Shapes, Use};
use crate::turned_faces::turn_to_agree;

/// Edges, faces or parts that one thread makes in one go.
const AT_ONCE: usize = 16;

pub struct Model {
    pub locations: Locations,
    pub edges: Vec<Edge>,
    pub faces: Vec<Face>,
    pub parts: Vec<Part>,
    pub topology: Vec<PartTopology>,
    /// Classes by part and edge.
    pub classes: Vec<Vec<Classes>>,
    /// Faces that lie on another face beside a common edge, in ascending order.
    pub folded: Vec<u32>,
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
        let mut found = explore::explore(&mut dump, parts)?;
        found.parts.par_iter_mut().for_each(turn_to_agree);
        let mut locations = std::mem::replace(&mut dump.locations, Locations::none());
        let mut edges = made(
            &found.edges,
            &mut locations,
            |shape| edge_unplaced(&dump, *shape),
            |shape, locations| edge(&dump, *shape, locations),
        );
        let mut number = vec![None; dump.shapes.len()];
        (0..).zip(&found.edges).for_each(|(i, &shape)| number[shape as usize] = Some(i));
        let mut faces = made(
            &found.faces,
            &mut locations,
            |shape| face_unplaced(&dump, *shape),
            |shape, locations| face(&dump, *shape, locations, &number, &edges),
        );
        mark_copies(&mut faces, &mut edges);
        let topology = made(
            &found.parts,
            &mut locations,
            |part| part_unplaced(part, &faces),
            |part, locations| part_topology(part, &faces, &edges, locations),
        );
        let (parts, curves2) = (found.parts, std::mem::take(&mut dump.curves2));
        let mut model =
            Model { locations, edges, faces, parts, topology, classes: Vec::new(), folded: Vec::new(), curves2 };
        model.classify();
        release(dump);
        Ok(model)
    }

    /// Classifies the edges of all parts. Where the class changes along an edge, its polyline gets a corner.
    pub(crate) fn classify(&mut self) {
        let shapes = Shapes { edges: &self.edges, faces: &self.faces, curves2: &self.curves2 };
        let of_part = |part: &PartTopology| -> Vec<Classes> {
            (0..part.edges.len()).into_par_iter().map(|edge| classes(shapes, part, edge)).collect()
        };
        self.classes = self.topology.par_iter().map(of_part).collect();
        let parts = self.topology.par_iter().zip(&self.classes);
        self.folded = parts.flat_map_iter(|(part, classes)| folded(shapes, part, classes)).collect();
        self.folded.sort_unstable();
        self.folded.dedup();
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

/// Releases what was read, on another thread where there is one: that takes a tenth as long as making the model of it.
fn release(dump: Dump) {
    // A pool of one thread would keep the job until the thread ends.
    if rayon::current_num_threads() > 1 {
        rayon::spawn(move || drop(dump));
    }
}

/// Makes something of each item. Those that are `unplaced` need no locations, and are made side by side; the others one
/// after another, so that new locations get the same numbers in every run.
fn made<T: Sync, U: Send>(
    items: &[T],
    locations: &mut Locations,
    unplaced: impl Fn(&T) -> bool + Sync,
    make: impl Fn(&T, &mut Locations) -> U + Sync,
) -> Vec<U> {
    let side_by_side = items.par_iter().with_min_len(AT_ONCE);
    if items.iter().all(&unplaced) {
        return side_by_side.map_init(Locations::none, |none, item| make(item, none)).collect();
    }
    let alone = |none: &mut Locations, item: &T| unplaced(item).then(|| make(item, none));
    let found: Vec<Option<U>> = side_by_side.map_init(Locations::none, alone).collect();
    found.into_iter().zip(items).map(|(found, item)| found.unwrap_or_else(|| make(item, locations))).collect()
}

/// Whether no location of an edge but the identity is asked for.
fn edge_unplaced(dump: &Dump, shape: u32) -> bool {
    let shape = &dump.shapes[shape as usize];
    let Kind::Edge { on, .. } = shape.kind else { return false };
    let here = |on: &On| match *on {
        On::Curve { location, .. } | On::Surface { location, .. } | On::Polygon { location, .. } => location == 0,
    };
    dump.on(on).iter().all(here) && shape.subs.iter().all(|sub| sub.location == 0)
}

fn face_unplaced(dump: &Dump, shape: u32) -> bool {
    let shape = &dump.shapes[shape as usize];
    let here = |subs: &[Sub]| subs.iter().all(|sub| sub.location == 0);
    matches!(shape.kind, Kind::Face { location: 0, .. })
        && here(&shape.subs)
        && shape.subs.iter().all(|wire| here(&dump.shapes[wire.shape as usize].subs))
}

fn part_unplaced(part: &Part, faces: &[Face]) -> bool {
    let of_face = |face: &u32| faces[*face as usize].wires.iter().flatten().all(|used| used.location == 0);
    part.edges.iter().all(|edge| edge.location == 0)
        && part.faces.iter().all(|face| face.location == 0 && of_face(&face.face))
}

fn edge(dump: &Dump, shape: u32, locations: &mut Locations) -> Edge {
    let Shape { kind, subs } = &dump.shapes[shape as usize];
    let &Kind::Edge { tolerance, degenerate, on, continuity, .. } = kind else { unreachable!("an edge") };
    let on = dump.on(on);
    let mut found = Edge {
        curve: None,
        range: [0.0; 2],
        tolerance,
        degenerate,
        ends: [None; 2],
        end_points: [None; 2],
        // 0: nothing recorded, 1: C0, above: tangent.
        tangent: continuity > 1,
        on: Vec::with_capacity(on.iter().filter(|on| matches!(on, On::Surface { .. })).count()),
        polygon: None,
        only_on: None,
        joints: Vec::new(),
        original: None,
    };
    for on in on {
        match *on {
            On::Curve { curve, location, range } if found.curve.is_none() => {
                let location = locations.written(location);
                found.curve = if location == 0 {
                    dump.curves[curve].clone()
                } else {
                    let matrix = locations.matrix(location);
                    dump.curves[curve].as_ref().map(|curve| curve.moved(&matrix))
                };
                found.range = range;
            }
            On::Surface { curves, surface, location, range } => {
                let location = locations.written(location);
                found.on.push(OnSurface { surface, location, curves, range });
            }
            On::Polygon { polygon, location } if found.polygon.is_none() => {
                let location = locations.written(location);
                let matrix = locations.matrix(location);
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
            let matrix = locations.matrix(on.location);
            found.only_on = dump.surfaces[on.surface]
                .as_ref()
                .and_then(|r| Surface::read(r.kind, &moved(r.kind, &r.data, &matrix)?))
                .map(|surface| Box::new((on.curves[0], surface)));
        }
    }
    for sub in subs {
        let end = match sub.orientation {
            Orientation::Forward => 0,
            Orientation::Reversed => 1,
            _ => continue,
        };
        if found.ends[end].is_none() {
            let location = locations.written(sub.location);
            let Kind::Vertex { point, tolerance, .. } = dump.shapes[sub.shape as usize].kind else { continue };
            if degenerate {
                // A pole lies where its vertex does, and no more exactly.
                found.tolerance = found.tolerance.max(tolerance);
            }
            found.ends[end] = Some((sub.shape, location));
            found.end_points[end] = Some(crate::format::moved(&locations.matrix(location), &point));
        }
    }
    found
}

fn face(dump: &Dump, shape: u32, locations: &mut Locations, number: &[Option<u32>], edges: &[Edge]) -> Face {
    let Shape { kind, subs } = &dump.shapes[shape as usize];
    let &Kind::Face { tolerance, surface, location, triangulation } = kind else { unreachable!("a face") };
    let location = locations.written(location);
    let record = if location == 0 {
        surface.and_then(|i| dump.surfaces[i].clone())
    } else {
        let matrix = locations.matrix(location);
        let written = surface.and_then(|i| dump.surfaces[i].as_ref());
        written.and_then(|r| Some(SurfaceRecord { kind: r.kind, data: moved(r.kind, &r.data, &matrix)? }))
    };
    let read = record.as_ref().and_then(|r| Surface::read(r.kind, &r.data));
    let own = if surface.is_none() { triangulation.and_then(|i| dump.triangulations.get(i).cloned()) } else { None };
    let mut wires = Vec::with_capacity(subs.len());
    for wire in subs {
        let Shape { kind: Kind::Wire, subs: inner } = &dump.shapes[wire.shape as usize] else { continue };
        let outer = locations.written(wire.location);
        let mut uses = Vec::with_capacity(inner.len());
        for &sub in inner {
            let Some(edge) = number[sub.shape as usize] else { continue };
            let within = locations.written(sub.location);
            let stands = locations.product(outer, within);
            let orientation = wire.orientation.compose(sub.orientation);
            let wanted = locations.quotient(stands, location);
            let on = &edges[edge as usize].on;
            let of_surface = |on: &&OnSurface| Some(on.surface) == surface;
            let fits = on.iter().filter(of_surface).find(|on| on.location == wanted);
            let curve2 = fits.or_else(|| on.iter().find(of_surface)).map(|on| {
                let reversed = orientation == Orientation::Reversed;
                (on.curves[usize::from(reversed)], on.range)
            });
            let curve2 = curve2.filter(|(_, range)| range.iter().all(|t| t.is_finite()));
            let place = (stands != 0).then(|| Box::new(locations.matrix(stands)));
            let ends = edges[edge as usize].ends(edge);
            let ends = ends.map(|(shape, location)| (shape, locations.product(stands, location)));
            uses.push(Use { edge, location: stands, place, orientation, ends, curve2 });
        }
        wires.push(uses);
    }
    Face { record, surface: read, tolerance, wires, own, no_area: false }
}
