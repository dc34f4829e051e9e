//! Prepares the facets that every method starts from: project, clip, round, compute planes, cull, triangulate.

use super::back_face::{Facing, facing};
use super::clip::{Corner, Wall, clip_loop, walls};
use super::depth_grid::{DepthGrid, Noise};
use super::limits::Watch;
use super::patch::Patch;
use super::plane::{LIMIT, Plane, Point, STEPS, centre, first_centre, turn, widest};
use super::scene::{Camera, Cubic, Scene};
use super::screen::{FAR, Facet, NEAR_TIE, NONE, STEEP, Screen};
use super::statistics::Statistics;
use super::triangulate::triangulate;
use std::ops::Range;

/// Steps of depth: a corner no farther than this from the plane of a polygon is on it.
const LEVEL: i128 = 4;
/// Share of the range of depths of a facet's plane: how far from a plane a corner may lie after repeated cuts by
/// planes.
const CUT: f64 = 1.0 / (1u64 << 32) as f64;

/// What is done with polygons whose corners rounding has moved out of their plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bent {
    /// Triangles, which are exact: for pictures.
    Triangulated,
    /// They stay in one piece and in one plane: for lists of polygons, where a little depth does not matter.
    Whole,
}

/// The scene as seen by the camera; None where time ran out.
pub fn screen(
    scene: &Scene,
    camera: &Camera,
    bent: Bent,
    watch: &Watch,
    statistics: &mut Statistics,
) -> Option<Screen> {
    // 1. project all points; which of them lie outside which wall
    let (frame, guard) =
        (walls(camera, 0.0), walls(camera, LIMIT / STEPS as f64 - f64::from(camera.width.max(camera.height))));
    let projected: Vec<[f64; 4]> = scene.points.iter().map(|p| camera.project(p)).collect();
    let codes = |walls: &[Wall]| -> Vec<u8> { projected.iter().map(|p| outcode(p, walls)).collect() };
    let (unseen, outside) = (codes(&frame), codes(&guard));
    // 2. clip; project
    let mut flat = Flat::default();
    let mut work = Vec::new();
    for polygon in 0..scene.len() {
        if watch.over() {
            return None;
        }
        match crossed(scene, polygon, &unseen, &outside) {
            Place::Beyond => statistics.clipped += 1,
            // Mostly nothing crosses anything: no loop is copied then.
            Place::Within => {
                flat.add(polygon, scene.loops_of(polygon).map(|l| l.iter().map(|&i| corner(scene, &projected, i))))
            }
            Place::Crossing(crossed) => {
                statistics.clipped += 1;
                clipped(scene, polygon, &projected, crossed, &guard, &mut work);
                flat.add(polygon, work.iter().map(|l| l.iter().copied()));
            }
        }
    }
    statistics.polygons = scene.len() as u64;
    // 3. round, with one step of depth for all
    let sign = camera.matrix[2][2];
    let bounds = scene.patches.iter().flat_map(|(_, curve)| curve.range.map(|z| [0.0, 0.0, sign * z]));
    let reached: Vec<[f64; 3]> = flat.points.iter().copied().chain(bounds).collect();
    let depths = DepthGrid::new(camera, if scene.patches.is_empty() { &flat.points } else { &reached });
    let reciprocals: Vec<f64> = flat.values.iter().map(|v| v[3]).collect();
    let noise = Noise::new(scene, camera);
    let mut out = Screen {
        width: i64::from(camera.width),
        height: i64::from(camera.height),
        rule: scene.rule,
        points: flat.points.iter().map(snap).collect(),
        values: if scene.values.is_empty() { Vec::new() } else { flat.values },
        loops: Vec::with_capacity(flat.loops.len()),
        facets: Vec::with_capacity(flat.polygons.len()),
        patches: Vec::new(),
        depths,
    };
    // 4. planes, culling, triangles where there is no plane
    for (id, loops) in &flat.polygons {
        if watch.over() {
            return None;
        }
        let given = Given {
            id: *id,
            loops: &flat.loops[loops.start as usize..loops.end as usize],
            exact: &flat.points,
            reciprocals: &reciprocals,
            cull: scene.cull[*id as usize],
        };
        match scene.patch(*id) {
            Some(curve) => out.add_patch(&given, curve, sign, &noise, statistics),
            None => out.add(&given, &noise, bent, watch, statistics)?,
        }
    }
    statistics.facets = out.facets.len() as u64;
    Some(out)
}

fn outcode(p: &[f64; 4], walls: &[Wall]) -> u8 {
    // A corner that is NaN is outside of every wall.
    walls.iter().enumerate().fold(0, |code, (k, wall)| if wall.height(p) >= 0.0 { code } else { code | 1 << k })
}

/// Where a polygon lies: wholly beyond one plane of the view volume; across some of the walls, as bits; or neither.
enum Place {
    Beyond,
    Within,
    Crossing(u8),
}

fn crossed(scene: &Scene, polygon: usize, unseen: &[u8], outside: &[u8]) -> Place {
    let (mut any, mut all) = (0u8, u8::MAX);
    for &i in scene.loops_of(polygon).flatten() {
        any |= outside[i as usize];
        all &= unseen[i as usize];
    }
    match (all, any) {
        (0, 0) => Place::Within,
        (0, _) => Place::Crossing(any),
        _ => Place::Beyond,
    }
}

fn corner(scene: &Scene, projected: &[[f64; 4]], i: i32) -> Corner {
    let value = scene.values.get(i as usize).copied().unwrap_or([0.0; 3]);
    Corner { at: projected[i as usize], value }
}

/// The loops of one polygon after clipping by the walls that it crosses; empty ones are left out.
fn clipped(
    scene: &Scene,
    polygon: usize,
    projected: &[[f64; 4]],
    crossed: u8,
    walls: &[Wall],
    out: &mut Vec<Vec<Corner>>,
) {
    out.clear();
    out.extend(scene.loops_of(polygon).map(|l| l.iter().map(|&i| corner(scene, projected, i)).collect::<Vec<_>>()));
    let mut next = Vec::new();
    for wall in walls.iter().enumerate().filter(|(k, _)| crossed >> k & 1 != 0).map(|(_, wall)| wall) {
        for l in out.iter_mut() {
            clip_loop(l, wall, &mut next);
            std::mem::swap(l, &mut next);
        }
    }
    out.retain(|l| l.len() > 2);
}

/// Clipped polygons after the division: pixels and depth, not yet rounded.
#[derive(Default)]
struct Flat {
    points: Vec<[f64; 3]>,
    values: Vec<[f64; 4]>,
    loops: Vec<Range<u32>>,
    polygons: Vec<(u32, Range<u32>)>,
}

impl Flat {
    fn add(&mut self, polygon: usize, loops: impl Iterator<Item = impl Iterator<Item = Corner>>) {
        let first = self.loops.len() as u32;
        for l in loops {
            let start = self.points.len() as u32;
            for c in l {
                let [u, v, q, w] = c.at;
                self.points.push([u / w, v / w, q / w]);
                self.values.push([c.value[0], c.value[1], c.value[2], 1.0 / w]);
            }
            self.loops.push(start..self.points.len() as u32);
        }
        if self.loops.len() as u32 > first {
            self.polygons.push((polygon as u32, first..self.loops.len() as u32));
        }
    }
}

/// Rounds x and y of a corner; depth follows (`DepthGrid::lay`).
fn snap(p: &[f64; 3]) -> Point {
    let at = |v: f64| (v * STEPS as f64).round_ties_even().clamp(-LIMIT, LIMIT) as i64;
    [at(p[0]), at(p[1]), 0]
}

/// A polygon in camera coordinates, not yet rounded.
struct Given<'a> {
    id: u32,
    loops: &'a [Range<u32>],
    exact: &'a [[f64; 3]],
    /// 1 / w.
    reciprocals: &'a [f64],
    cull: bool,
}

impl Given<'_> {
    fn corners(&self) -> Range<usize> {
        let ends = (self.loops.first(), self.loops.last());
        ends.0.map_or(0, |l| l.start as usize)..ends.1.map_or(0, |l| l.end as usize)
    }
}

impl Screen {
    /// A curved patch: its outline owns the pixels, as that of a polygon does; its depth comes from its polynomial.
    fn add_patch(&mut self, given: &Given, curve: &Cubic, sign: f64, noise: &Noise, statistics: &mut Statistics) {
        if widest(&self.points[given.corners()]).is_none() {
            statistics.edge_on += 1;
            return;
        }
        let before = self.facets.len();
        self.push(given, given.loops, Plane { a: 0, b: 0, c: 1, d: 0 }, noise);
        let number = self.patches.len() as u32;
        let depths = curve.range.map(|z| self.depths.number(sign * z));
        for facet in &mut self.facets[before..] {
            facet.patch = number;
            facet.depth = [depths[0].min(depths[1]).floor() as i64, depths[0].max(depths[1]).ceil() as i64];
            self.patches.push(Patch::new(curve, sign, facet.columns, facet.rows, &self.depths));
        }
    }

    /// Adds one polygon, as one facet or more.
    fn add(
        &mut self,
        given: &Given,
        noise: &Noise,
        bent: Bent,
        watch: &Watch,
        statistics: &mut Statistics,
    ) -> Option<()> {
        let corners = given.corners();
        let Some(best) = widest(&self.points[corners.clone()]) else {
            statistics.edge_on += 1;
            return Some(());
        };
        let best = best.map(|k| k + corners.start);
        let area = turn_of(best.map(|k| &self.points[k]));
        let runs = given.loops.iter().map(|l| &self.points[l.start as usize..l.end as usize]);
        if given.cull && facing(runs, area) == Facing::Back {
            statistics.culled += 1;
            return Some(());
        }
        let exact = &given.exact[corners.clone()];
        self.depths.lay(exact, best.map(|k| &given.exact[k]), &mut self.points[corners.clone()]);
        let plane = Plane::through(best.map(|k| &self.points[k])).facing();
        let level = LEVEL * i128::from(plane.c);
        if corners.len() == 3 || bent == Bent::Whole || self.points[corners].iter().all(|p| plane.at(p).abs() <= level)
        {
            self.push(given, given.loops, plane, noise);
            return Some(());
        }
        let ranges: Vec<_> = given.loops.iter().map(|l| l.start as usize..l.end as usize).collect();
        let Some(triangles) = triangulate(&self.points, &ranges, self.rule, watch) else {
            self.push(given, given.loops, plane, noise);
            return (!watch.over()).then_some(());
        };
        statistics.triangulated += 1;
        for t in triangles {
            let start = self.points.len() as u32;
            for i in t {
                self.points.push(self.points[i]);
                if !self.values.is_empty() {
                    self.values.push(self.values[i]);
                }
            }
            let corners = [0, 1, 2].map(|k| &self.points[start as usize + k]);
            if turn_of(corners) != 0 {
                let plane = Plane::through(corners).facing();
                self.push(given, std::slice::from_ref(&(start..start + 3)), plane, noise);
            }
        }
        Some(())
    }

    /// How far the rounded plane may lie from the true one within the polygon, in steps of depth: measured at its
    /// unrounded corners, plus the floating-point error before and after that.
    fn slack(&self, given: &Given, plane: &Plane, base: &Point, reach: f64, noise: &Noise) -> f64 {
        let c = plane.c as f64;
        let (right, down) = (-(plane.a as f64) / c, -(plane.b as f64) / c);
        let mut worst = 0.0f64;
        for k in given.corners() {
            let [x, y, z] = given.exact[k];
            let there = base[2] as f64
                + right * (x * STEPS as f64 - base[0] as f64)
                + down * (y * STEPS as f64 - base[1] as f64);
            let [of_image, of_depth] = noise.at(&given.exact[k], given.reciprocals[k]);
            let blurred = self.depths.steps(of_depth) + of_image * STEPS as f64 * (right.abs() + down.abs());
            worst = worst.max((self.depths.number(z) - there).abs() + blurred);
        }
        // Doubled, for the planes of two facets of one polygon that is not quite planar; where the slope is unknown, no
        // depth is trusted.
        let slack = 2.0 * worst + NEAR_TIE + reach * CUT;
        if slack.is_finite() { slack } else { f64::INFINITY }
    }

    /// Adds a facet of loops of `points`; its plane has C > 0.
    fn push(&mut self, given: &Given, loops: &[Range<u32>], plane: Plane, noise: &Noise) {
        let (mut low, mut high) = ([i64::MAX; 3], [i64::MIN; 3]);
        for l in loops {
            for p in &self.points[l.start as usize..l.end as usize] {
                // The plane's depth at its corners: that of the corners, unless the polygon is warped.
                let n = plane.depth(p[0], p[1]);
                let c = i128::from(plane.c);
                let z = [n.div_euclid(c), -(-n).div_euclid(c)].map(|z| z.clamp(-FAR, FAR) as i64);
                for k in 0..2 {
                    low[k] = low[k].min(p[k]);
                    high[k] = high[k].max(p[k]);
                }
                low[2] = low[2].min(z[0]);
                high[2] = high[2].max(z[1]);
            }
        }
        let columns = [first_centre(low[0]).max(0), first_centre(high[0]).min(self.width as i32)];
        let rows = [first_centre(low[1]).max(0), first_centre(high[1]).min(self.height as i32)];
        // A facet between pixel centres is invisible.
        if columns[0] >= columns[1] || rows[0] >= rows[1] {
            return;
        }
        let first = self.loops.len() as u32;
        self.loops.extend_from_slice(loops);
        let c = plane.c as f64;
        let start = plane.depth(centre(columns[0].into()), centre(rows[0].into())) as f64 / c;
        let (right, down) = (-(plane.a as f64) * STEPS as f64 / c, -(plane.b as f64) * STEPS as f64 / c);
        let reach =
            start.abs() + right.abs() * f64::from(columns[1] - columns[0]) + down.abs() * f64::from(rows[1] - rows[0]);
        let base = self.points[loops[0].start as usize];
        // The plane's depth there, in case the corner is off the plane.
        let z = plane.depth(base[0], base[1]).div_euclid(plane.c.into()).clamp(-FAR, FAR) as i64;
        self.facets.push(Facet {
            id: given.id,
            loops: first..self.loops.len() as u32,
            plane,
            columns,
            rows,
            depth: [low[2], high[2]],
            start: if reach < STEEP { start } else { f64::NAN },
            right,
            down,
            slack: self.slack(given, &plane, &[base[0], base[1], z], reach, noise),
            patch: NONE,
        });
    }
}

fn turn_of([p, q, r]: [&Point; 3]) -> i64 {
    turn(p, q, r)
}
