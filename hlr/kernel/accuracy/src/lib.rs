//! The kernel's shares of the accuracy. `hlr/request/accuracy.py` has all others, and adds them up per class of line.
//!
//! Each number is a multiple of a length that the caller gives; the first words of its text name that length:
//!
//! ```text
//! accuracy         what a drawing promises, millimetres on paper
//! deflection       chord error asked of the mesher, half of the accuracy in the model
//! chord tolerance  chord error asked of outlines, a fifth of the deflection
//! contact depth    within which two surfaces touch
//! width            within which two lines coincide, half of the accuracy
//! ```

// The mesher.

/// Of the deflection: chord error of edges whose faces bend both ways. The triangles beside them need the rest.
pub const MESH_BORDER: f64 = 0.5;
/// Of the chord error asked for: the lattice inside a face aims at it, since its triangles are not quite equilateral.
pub const MESH_AIM: f64 = 0.85;
/// Of the deflection: the least length of an edge inside a face. Shorter ones show less than the deflection.
pub const MESH_SHORTEST: f64 = 2.0;
/// Of the error of the border chord beside it: a triangle there cannot be better.
pub const MESH_BESIDE_BORDER: f64 = 1.25;
/// Of the chord error asked for: for so much a face is meshed whose steps run out before it has any mesh.
pub const MESH_COARSER: f64 = 16.0;
/// Of the chord error of the coarse mesh that leads a cut: how far a surface may bulge beyond it.
pub const CUT_BULGE: f64 = 2.0;
/// Of the chord error, over all of the area: by how much the volume of a cut body may differ from that of the mesh below
/// the plane.
pub const CUT_DISPLACED: f64 = 3.0;
/// Of the chord error asked for: chords are laid out for it, so that few have to be divided again.
pub const CHORD_AIM: f64 = 0.9;
/// Of the chord error asked for: chords of an edge that are off by more are divided again.
pub const CHORD_MOST: f64 = 1.01;
/// Of the deflection: chord error at the places of an edge in (u, v) that are looked at; the rest is for those between.
pub const CHORD_SAMPLED: f64 = 0.5;
/// Of the deflection: a vertex or an edge that is less certain than this counts as this certain.
pub const EDGE_CERTAIN: f64 = 0.05;
/// Of the deflection: a curve in (u, v) that is nearer to its edge than this stands for it.
pub const EDGE_IN_FACE: f64 = 0.1;

// Where parts meet.

/// Of the deflection: a wall, or another planar face, that reaches less far beyond a planar face stands on it, and has no
/// line there but its own edge. In view depth that takes more, the more obliquely one looks: `CONTACT_PLANAR` is ten times as much.
pub const FLUSH: f64 = 0.25;
/// Of the contact depth: that at right angles to a surface. Two tessellations are off by one deflection each, which is this
/// much, and one accuracy; the rest is for surfaces seen obliquely. What goes deeper is an intersection, with a line: for
/// its own edges are hidden where they are seen at a slant.
pub const CONTACT_AT_RIGHT_ANGLES: f64 = 0.4;
/// Of the contact depth: an edge that lies less deep beneath a surface, at right angles to it, touches the surface and is
/// seen. What goes less deep than `CONTACT_AT_RIGHT_ANGLES` has no line of its own, and the chords of the edge and of the
/// surface may be deeper by as much.
pub const TOUCHING_AT_RIGHT_ANGLES: f64 = 0.8;
/// The same where both parts have an intersection line somewhere: it and the edge would often be drawn side by side.
pub const TOUCHING_BESIDE_A_LINE: f64 = 0.45;
/// Of the contact depth: what one face of a solid may dip into another face of the same solid. On sound solids facets
/// cross by a fifth of a deflection at most.
pub const CONTACT_OF_ONE_SOLID: f64 = 0.1;
/// Of the contact depth: a figure of intersection is real where it is deeper than this. Rounding goes less deep.
pub const CONTACT_REAL: f64 = 0.03;
/// Of the deflection: a crossing that is shorter is a point, and a point that is this much farther from one border than
/// from another lies on both.
pub const CONTACT_POINT: f64 = 1e-3;

// Intersection lines.

/// Of the deflection, over the sine of the angle between two surfaces: how far the line of their meshes may be from the
/// true one. Each mesh is off by one deflection.
pub const INTERSECTION_MOVE: f64 = 4.0;
/// Of the deflection: an intersection line along which one surface is nowhere deeper in the other is shallow. This is four
/// accuracies. Up to three of them, the sunk surface's own edge and the line are less far apart on paper than a pen is
/// wide; the fourth is for the chord errors of both.
pub const INTERSECTION_SHALLOW: f64 = 8.0;
/// Of the deflection: how far a point may be from a surface, or from an ellipse, that it lies on.
pub const INTERSECTION_MET: f64 = 1e-3;
/// Of the deflection: how far the cubic pieces of an intersection line may be from it.
pub const INTERSECTION_FIT: f64 = 0.02;

// Outlines.

/// Of the chord tolerance: the two ends of a fold shorter than this are one.
pub const OUTLINE_GAP: f64 = 0.5;
/// Of the chord tolerance: how far a point of an outline may be from the circle that it becomes.
pub const OUTLINE_CIRCLE: f64 = 1e-3;
/// Of the chord tolerance: the step over which tangents of outlines are differentiated.
pub const OUTLINE_TANGENT_STEP: f64 = 0.05;
/// Of the chord tolerance: chords that turn by 30 degrees along a circle are 15 times as long as they are off it; longer
/// ones meet in a corner.
pub const OUTLINE_CORNER: f64 = 20.0;
/// Of the chord tolerance, of which an accuracy has ten: a wrinkle of a surface that rises by less is no outline.
pub const OUTLINE_WRINKLE: f64 = 15.0;
/// Of the chord tolerance: a triangle no higher than this may lie on either side of its own border, once its corners are
/// rounded to the grid.
pub const OUTLINE_FLAT: f64 = 0.25;
/// Of the chord tolerance, of which a deflection has five: borders of one wall this close in the image may be one line.
pub const OUTLINE_BEHIND: f64 = 10.0;
/// Of the chord tolerance, of which an accuracy has ten: a ridge of a surface that rises by less hides nothing of the
/// valley behind it.
pub const OUTLINE_VALLEY: f64 = 5.0;

// Lines on their curves.

/// Of the accuracy: how far a fitted curve may be from the true one. Lines that end on another's true curve are as far
/// from what is drawn. Little is cheap here: the error of a cubic falls with the sixth power of its length, so half of it
/// takes an eighth more cubics.
pub const CURVE_FIT: f64 = 0.05;
/// Of the accuracy: a curve that bulges less is drawn as a straight line. Writers round by more.
pub const CURVE_STRAIGHT: f64 = 0.05;
/// Of the accuracy: how far beyond the end of its line a curve that is seen edge-on may turn back. The line began at a
/// corner of the mesh, and chords are as far from the curve as the deflection.
pub const CURVE_TURN: f64 = 0.5;
/// Of the accuracy: an end of a line this close to the end of its curve is that end.
pub const CURVE_END: f64 = 0.02;
/// Of the accuracy: how far a line may be from its curve between two vertices, where the mesh is off by more than at
/// them.
pub const CURVE_BETWEEN: f64 = 4.0;
/// Of the accuracy: ends of one edge's lines this close are one point, parted by rounding.
pub const CURVE_SHARED_END: f64 = 1e-6;

/// Of the accuracy: how far a vertex of a mesh's contour may move when the contour is smoothed.
pub const CONTOUR_MOVE: f64 = 0.5;
/// Of the accuracy: how far curves may be from the moved contour.
pub const CONTOUR_FIT: f64 = 0.3;
/// Of the accuracy: vertices nearer than this to their chord are no vertices of the shape.
pub const CONTOUR_FLAT: f64 = 0.15;
/// Of the accuracy: how far a curve may bulge beyond one chord for the sake of its tangents.
pub const CONTOUR_BULGE: f64 = 0.2;
/// Of the accuracy: how far the points along a contour's curve may be from it between them.
pub const CONTOUR_CHORD: f64 = 0.1;

// Changes of visibility, moved to where the covering line crosses.

/// Of the accuracy: how far the covering polyline may be from the change, where one of the two lines is an outline:
/// outlines are compared with the tessellation beside it, not on it.
pub const JUNCTION_OUTLINE: f64 = 2.0;
/// Of the accuracy: the same between edges.
pub const JUNCTION_EDGE: f64 = 1.0;
/// Of the accuracy: lines this close touch.
pub const JUNCTION_TOUCH: f64 = 0.2;
/// Of the accuracy: how far along touching lines the change may move.
pub const JUNCTION_ALONG: f64 = 30.0;
/// Of the accuracy: a change this close to a point of an intersection line is where the line goes through the surface.
pub const JUNCTION_PIERCED: f64 = 0.02;
/// Of the accuracy, on paper and in space: a line that takes over a bit of another keeps the corner between them where
/// it would pass farther from it.
pub const JUNCTION_CORNER: f64 = 0.25;
/// Of the accuracy: two curves this close have met.
pub const JUNCTION_MET: f64 = 1e-4;
/// Millimetres on paper: how far before the place where it touches an outline a line may end, and yet go on to it. Where
/// a surface is seen at less than a certain angle, its facets hide what lies on it, however fine they are.
pub const JOINT_REACH: f64 = 20.0;

// What is too short to be drawn.

/// Of the accuracy: the longest hidden run of a mesh's contour that its own folds explain.
pub const RUN_NOISE: f64 = 6.0;
/// Of the shortest length drawn: a line of its own below this is a dot.
pub const SPECK_DOT: f64 = 0.25;
/// Of the width: covered stretches of a visible line that are shorter are crossings, not coincidence.
pub const COVER_CROSSING: f64 = 6.0;
/// Of the width: for a hidden line the same multiple of the visible ink, which counts as at least this wide. With finer
/// ink more would be cut out beside cusps, where contours end.
pub const COVER_INK: f64 = 6.0;

// Lines in files.

/// Of the accuracy: points this close to a straight line are on it, but for rounding.
pub const LINE_ROUNDED: f64 = 1e-6;

// Arcs in files.

/// Of the accuracy: how far an SVG arc may be from the true one once its ends, radii and rotation are rounded.
pub const ARC_FIT: f64 = 0.2;
/// Of the accuracy: an ellipse whose radii differ by less is a circle, and a rotation that moves it by less is rounded
/// off.
pub const ARC_ROUND: f64 = 0.01;
/// Of the accuracy: how far the cubic curves of an arc in PDF may be from it.
pub const ARC_CUBIC: f64 = 0.1;
