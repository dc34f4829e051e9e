"""Files made to do harm: each asks for more memory, depth or time than it is worth."""

from __future__ import annotations

import io
import json
import struct
import zipfile

MODEL = (
    '<?xml version="1.0"?>{prolog}<model unit="millimeter" '
    'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>{resources}</resources>'
    '<build><item objectid="1"/></build></model>'
)
MESH = (
    '<object id="{id}" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>'
    '<vertex x="0" y="1" z="{z}"/></vertices><triangles>{triangles}</triangles></mesh></object>'
)
TRIANGLE = '<triangle v1="0" v2="1" v3="2"/>'
STEP = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
STEP += "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n{data}\nENDSEC;\nEND-ISO-10303-21;\n"
BREP = "DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations {locations}\n{rest}"


def _3mf(model: str | bytes) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("3D/3dmodel.model", model)
    return out.getvalue()


def _mesh(id: int = 1, z: str = "0", triangles: str = TRIANGLE) -> str:
    return MESH.format(id=id, z=z, triangles=triangles)


def _model(resources: str, prolog: str = "") -> bytes:
    return _3mf(MODEL.format(prolog=prolog, resources=resources))


def _glb(tree: object, binary: bytes = b"") -> bytes:
    return _glb_text(json.dumps(tree).encode(), binary)


def _glb_text(text: bytes, binary: bytes = b"") -> bytes:
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    if binary:
        chunks += struct.pack("<II", len(binary), 0x004E4942) + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _gltf(nodes: list[object], count: int = 3, offset: int = 0, indices: bytes = b"") -> bytes:
    """A triangle, hung on these nodes."""
    binary = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + indices
    tree: dict[str, object] = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, **({"indices": 1} if indices else {})}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteOffset": offset, "byteLength": 36}],
        "buffers": [{"byteLength": len(binary)}],
    }
    if indices:
        tree["accessors"] += [{"bufferView": 1, "componentType": 5125, "count": len(indices) // 4, "type": "SCALAR"}]  # type: ignore[operator]
        tree["bufferViews"] += [{"buffer": 0, "byteOffset": 36, "byteLength": len(indices)}]  # type: ignore[operator]
    return _glb(tree, binary)


def _ply(elements: str, body: bytes = b"", form: str = "ascii") -> bytes:
    return f"ply\nformat {form} 1.0\n{elements}end_header\n".encode() + body


XYZ = "property float x\nproperty float y\nproperty float z\n"
LIST = "property list uchar int vertex_indices\n"
DEEP = 100_000

FILES: dict[str, bytes] = {
    "bomb.3mf": _3mf(b"<model>" + b" " * (70 << 20)),
    "entities.3mf": _model(
        "&d;", '<!DOCTYPE m [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;"><!ENTITY d "&b;&b;&b;&b;">]>'
    ),
    "file-entity.3mf": _model("&x;", '<!DOCTYPE m [<!ENTITY x SYSTEM "file:///etc/passwd">]>'),
    "deep.3mf": _model("<a>" * DEEP + "</a>" * DEEP),
    "itself.3mf": _model(
        '<object id="1" type="model"><components><component objectid="1"/></components></object>' + _mesh(2)
    ),
    "doubling.3mf": _model(
        "".join(
            f'<object id="{i}" type="model"><components><component objectid="{i + 1}"/><component objectid="{i + 1}"/>'
            "</components></object>"
            for i in range(1, 40)
        )
        + _mesh(40)
    ),
    "index.3mf": _model(_mesh(triangles='<triangle v1="0" v2="1" v3="4294967295"/>')),
    "minus.3mf": _model(_mesh(triangles='<triangle v1="0" v2="1" v3="-1"/>')),
    "nan.3mf": _model(_mesh(z="nan")),
    "word.3mf": _model(_mesh(z="far")),
    "triangle.glb": _gltf([{"mesh": 0}]),
    "count.glb": _gltf([{"mesh": 0}], count=2**31),
    "minus.glb": _gltf([{"mesh": 0}], count=-1),
    "offset.glb": _gltf([{"mesh": 0}], offset=2**40),
    "indices.glb": _gltf([{"mesh": 0}], indices=struct.pack("<3I", 0, 1, 2**32 - 1)),
    "cycle.glb": _gltf([{"children": [1]}, {"children": [0], "mesh": 0}]),
    "itself.glb": _gltf([{"children": [0], "mesh": 0}]),
    "chain.glb": _gltf([*({"children": [i + 1], "scale": [1.1, 1.1, 1.1]} for i in range(3000)), {"mesh": 0}]),
    "doubling.glb": _gltf([*({"children": [i + 1, i + 1]} for i in range(40)), {"mesh": 0}]),
    "deep.glb": _glb_text(b"[" * DEEP + b"]" * DEEP),
    "draco.glb": _glb({"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_draco_mesh_compression"]}),
    "no-mesh.glb": _gltf([{"mesh": 7}]),
    "vertices.ply": _ply(f"element vertex {10**12}\n{XYZ}element face 1\n{LIST}", b"0 0 0\n"),
    "binary.ply": _ply(f"element vertex {10**12}\n{XYZ}", b"\0" * 64, "binary_little_endian"),
    "faces.ply": _ply(f"element vertex 3\n{XYZ}element face {10**9}\n{LIST}", b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
    "list.ply": _ply(
        f"element vertex 3\n{XYZ}element face 1\nproperty list uint int vertex_indices\n",
        b"\0" * 36 + struct.pack("<I3i", 2**32 - 1, 0, 1, 2),
        "binary_little_endian",
    ),
    "minus.ply": _ply(f"element vertex -3\n{XYZ}element face 1\n{LIST}", b"3 0 1 2\n"),
    "index.ply": _ply(f"element vertex 3\n{XYZ}element face 1\n{LIST}", b"0 0 0\n1 0 0\n0 1 0\n3 0 1 99999999999\n"),
    "elements.ply": _ply("".join(f"element e{i} 1\nproperty float x\n" for i in range(20_000))),
    "index.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 999999999999\n",
    "minus.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -9999\n",
    "slashes.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/9/9 2//99999 3/7\n",
    "polygon.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf " + b"1 2 3 " * 50_000 + b"\n",
    "library.obj": b"mtllib /etc/passwd\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\n",
    "groups.obj": b"".join(b"o g%d\nv 0 0 %d\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\n" % (i, i) for i in range(300)),
    "huge.obj": b"v 0 0 0\nv 1e308 -1e308 0\nv 0 1e308 1e308\nf 1 2 3\n",
    "count.stl": b"\0" * 80 + struct.pack("<I", 2**32 - 1) + b"\0" * 200,
    "nan.stl": b"\0" * 80 + struct.pack("<I", 1) + struct.pack("<12f", *[float("nan")] * 12) + b"\0\0",
    "largest.stl": b"\0" * 80 + struct.pack("<I12fH", 1, 0, 0, 1, *[3e38, -3e38, 0, -3e38, 3e38, 0, 3e38, 3e38, 1], 0),
    "words.stl": b"solid\nfacet normal 0 0 1\nouter loop\n" + b"vertex a b c\n" * 3 + b"endloop\nendfacet\nendsolid\n",
    "loop.stl": b"solid\nfacet normal 0 0 1\nouter loop\n" + b"vertex 0 0 0\n" * 5 + b"endloop\nendfacet\nendsolid\n",
    "counts.off": b"OFF\n999999999999 999999999999 0\n0 0 0\n",
    "arity.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n999999999 0 1 2\n",
    "index.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99999999999\n",
    "minus.off": b"OFF\n-3 -1 0\n0 0 0\n",
    "tiny.off": b"OFF\n3 1 0\n0 0 0\n5e-324 0 0\n0 5e-324 0\n3 0 1 2\n",
    "deep.step": STEP.format(data="#1=X(" + "(" * DEEP + ")" * DEEP + ");").encode(),
    "itself.step": STEP.format(data="#1=PRODUCT('a','a','',(#1));\n#2=SHAPE_REPRESENTATION('',(#2),#2);").encode(),
    "number.step": STEP.format(data="#99999999999999999999=CARTESIAN_POINT('',(0.,0.,0.));").encode(),
    "string.step": STEP.format(data="#1=PRODUCT('" + "a" * 1_000_000).encode(),
    "locations.brep": BREP.format(locations=2**31, rest="1\n").encode() + b"+1 0\n*\n+1 0 \n",
    "shapes.brep": BREP.format(locations=0, rest="Curve2ds 999999999\n").encode() + b"+1 0\n*\n+1 0 \n",
    "short.igs": b" " * 72 + b"S0000001\n",
    "pointer.igs": (
        " " * 72 + "S0000001\n" + f"{'1H,,1H;,1Ha,1Hb;':72}G0000001\n" + "99999999" * 9 + "D9999999\n"
    ).encode(),
}
