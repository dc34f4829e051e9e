//! What a dump is made of, whatever its encoding: numbers, flags, references to tables, and the few places where binary
//! and text differ.

use super::orientation::Orientation;

/// What is wrong with a dump, and at which byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Damaged {
    pub what: &'static str,
    pub at: usize,
    /// Its form is right, but it says what the kernel does not take; OpenCASCADE may.
    pub unsupported: bool,
}

impl std::fmt::Display for Damaged {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} (at byte {})", self.what, self.at)
    }
}

pub type Read<T> = Result<T, Damaged>;

/// The tables of a dump, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    Locations,
    Curves2,
    Curves,
    Polygons,
    OnTriangles,
    Surfaces,
    Triangulations,
    Shapes,
}

pub const TABLES: [Table; 8] = [
    Table::Locations,
    Table::Curves2,
    Table::Curves,
    Table::Polygons,
    Table::OnTriangles,
    Table::Surfaces,
    Table::Triangulations,
    Table::Shapes,
];

/// Flags of a shape.
pub const FLAGS: usize = 7;

impl Table {
    pub fn name(self) -> &'static str {
        [
            "Locations",
            "Curve2ds",
            "Curves",
            "Polygon3D",
            "PolygonOnTriangulations",
            "Surfaces",
            "Triangulations",
            "TShapes",
        ][self as usize]
    }
}

pub trait Tokens {
    /// The byte that is read next.
    fn at(&self) -> usize;

    /// Whether the rest can hold `count` items, of at least `size` bytes each in a binary dump.
    fn holds(&self, count: usize, size: usize) -> bool;

    /// The header of a table: its name and a count of items of at least `size` bytes.
    fn header(&mut self, table: Table, size: usize) -> Read<usize>;

    /// A small number that says what follows.
    fn kind(&mut self) -> Read<u8>;
    fn flag(&mut self) -> Read<bool>;
    fn short(&mut self) -> Read<usize>;
    fn integer(&mut self) -> Read<i32>;
    fn real(&mut self) -> Read<f64>;

    /// The number of an item of a table, counted from 1; 0 is none.
    fn number(&mut self, _table: Table) -> Read<i32> {
        self.integer()
    }

    /// A unit vector.
    fn direction<const N: usize>(&mut self) -> Read<[f64; N]>;

    /// The directions of z, x and y. `either`: the axes may be left-handed, as those of a surface.
    fn axes(&mut self, either: bool) -> Read<[[f64; 3]; 3]>;

    /// The directions of x and y in the plane.
    fn plane_axes(&mut self) -> Read<[[f64; 2]; 2]>;

    /// An elementary placement: rotation, mirror image, scale, translation.
    fn placement(&mut self) -> Read<[[f64; 4]; 3]>;

    /// Skips a polygon on a triangulation.
    fn skip_polygon_on_triangles(&mut self) -> Read<()>;

    /// Number of nodes and of triangles, whether there are parameters, and whether there are normals.
    fn triangulation(&mut self) -> Read<(usize, usize, bool, bool)>;

    /// Skips the normals of a triangulation.
    fn skip_normals(&mut self, count: usize) -> Read<()>;

    /// The kind of a shape: 0 compound to 7 vertex.
    fn shape(&mut self) -> Read<u8>;

    /// The kind of a place of a vertex, and the parameter there; 0 ends the list.
    fn place(&mut self) -> Read<(u8, f64)>;

    /// The kind of a representation of an edge; 0 ends the list.
    fn representation(&mut self) -> Read<u8>;

    /// The order of continuity: C0 0, G1 1, C1 2, G2 3, C2 4, C3 5, CN 6.
    fn continuity(&mut self) -> Read<u8>;

    /// Skips the ends of a curve in (u, v), where the layout has them.
    fn skip_ends(&mut self) -> Read<()>;

    /// The number of a face's own triangulation, counted from 1; 0 is none.
    fn own_triangles(&mut self, surface: bool) -> Read<i32>;

    /// The flags of a shape: free, modified, checked, orientable, closed, infinite, convex.
    fn flags(&mut self) -> Read<[bool; FLAGS]>;

    /// The orientation of a sub-shape; None ends the list.
    fn orientation(&mut self) -> Read<Option<Orientation>>;

    fn fault<T>(&self, what: &'static str) -> Read<T> {
        Err(Damaged { what, at: self.at(), unsupported: false })
    }

    /// The error for what is in the right form, but is nothing that the kernel takes.
    fn unsupported<T>(&self, what: &'static str) -> Read<T> {
        Err(Damaged { what, at: self.at(), unsupported: true })
    }

    fn finite(&mut self) -> Read<f64> {
        let value = self.real()?;
        if value.is_finite() { Ok(value) } else { self.fault("a number that is not finite") }
    }

    fn reals<const N: usize>(&mut self) -> Read<[f64; N]> {
        let mut out = [0.0; N];
        for value in &mut out {
            *value = self.finite()?;
        }
        Ok(out)
    }

    /// Reads a count of items of at least `size` bytes each. It may not exceed what the rest can hold.
    fn count(&mut self, size: usize) -> Read<usize> {
        let count = self.integer()?;
        self.fitting(count, size)
    }

    fn fitting(&self, count: i32, size: usize) -> Read<usize> {
        match usize::try_from(count) {
            Ok(count) if self.holds(count, size) => Ok(count),
            _ => self.fault("a count that the bytes cannot hold"),
        }
    }

    /// The number of an item of a table with `most` items, counted from 0.
    fn index(&mut self, table: Table, most: usize) -> Read<usize> {
        match self.maybe_index(table, most)? {
            Some(index) => Ok(index),
            None => self.fault("a reference to nothing"),
        }
    }

    /// The same; None where there is none.
    fn maybe_index(&mut self, table: Table, most: usize) -> Read<Option<usize>> {
        let number = self.number(table)?;
        self.counted(number, most)
    }

    fn counted(&self, number: i32, most: usize) -> Read<Option<usize>> {
        match usize::try_from(number) {
            Ok(0) => Ok(None),
            Ok(number) if number <= most => Ok(Some(number - 1)),
            _ => self.fault("a reference to nothing"),
        }
    }
}
