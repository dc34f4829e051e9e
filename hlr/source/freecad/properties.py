"""Values of FreeCAD's properties, as a document keeps them in XML and in files beside it."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from xml.etree.ElementTree import Element

from hlr.source.transforms import IDENTITY, MatrixRows

Vector = tuple[float, float, float]


class DamagedError(ValueError):
    """A value that no version of FreeCAD writes."""


@dataclass(frozen=True, slots=True)
class Properties:
    """Properties of one object, or of its view provider, by name.

    elements  the element that holds the value, by the name of the property
    file      the content of a file of the archive, by its name; None where it is missing
    """

    elements: Mapping[str, Element]
    file: Callable[[str], bytes | None]

    def __contains__(self, name: str) -> bool:
        return name in self.elements

    def text(self, name: str, default: str = "") -> str:
        """Of a string."""
        return self._value(name, default)

    def flag(self, name: str, default: bool) -> bool:
        """Of a switch."""
        return self._value(name, "true" if default else "false") == "true"

    def number(self, name: str, default: float, attribute: str = "value") -> float:
        """Of an integer, a float, a length or an angle: millimetres and degrees. attribute: in which it is kept."""
        element = self.elements.get(name)
        return _number(str(default) if element is None else element.get(attribute, str(default)))

    def count(self, name: str) -> int:
        """Of an integer that counts; 0 where there is none."""
        return max(0, int(self.number(name, 0.0)))

    def vector(self, name: str, default: Vector) -> Vector:
        """Of a vector."""
        element = self.elements.get(name)
        if element is None or element.get("valueX") is None:
            return default
        x, y, z = (_number(element.get(f"value{axis}", "0")) for axis in "XYZ")
        return x, y, z

    def placement(self, name: str) -> MatrixRows:
        """Of a placement; the identity where there is none."""
        element = self.elements.get(name)
        if element is None or element.get("Px") is None:
            return IDENTITY
        return placement_rows([_number(element.get(key, "0")) for key in ("Px", "Py", "Pz", "Q0", "Q1", "Q2", "Q3")])

    def link(self, name: str) -> str:
        """The name of the one object that a property refers to; empty where it is none, or in another document."""
        return next(iter(self.links(name)), "")

    def links(self, name: str) -> list[str]:
        """The names of the objects that a property refers to, in this document."""
        element = self.elements.get(name)
        if element is None:
            return []
        return [target for each in element.iter() if not each.get("file") and (target := _target(each))]

    def other_document(self, name: str) -> str:
        """The file of the other document that a link leads to; empty where it stays in this one."""
        element = self.elements.get(name)
        return "" if element is None or element.tag != "XLink" else element.get("file", "")

    def sub_names(self, name: str) -> list[str]:
        """The paths below the object that a link names: objects within it, or a face or an edge."""
        element = self.elements.get(name)
        if element is None:
            return []
        subs = [each.get("value" if each.tag == "Sub" else "sub", "") for each in element.iter()]
        return [sub for sub in subs if sub]

    def bits(self, name: str) -> str:
        """Of a list of switches: a 0 or a 1 each, the first one first. In the document it is the last."""
        return self._value(name, "")[::-1]

    def content(self, name: str) -> bytes | None:
        """The file in which a property keeps its value; empty where it keeps none, None where the file is missing."""
        element = self.elements.get(name)
        file = "" if element is None else element.get("file", "")
        return self.file(file) if file else b""

    def strings(self, name: str) -> list[str]:
        """Of a list of strings."""
        element = self.elements.get(name)
        return [] if element is None else [each.get("value", "") for each in element.iterfind("String")]

    def records(self, name: str) -> list[Element]:
        """Of a list of records, such as cosmetic lines: an element each."""
        element = self.elements.get(name)
        return [] if element is None else [each for each in element if len(each)]

    def texts(self, name: str) -> dict[str, str]:
        """Of a map from texts to texts."""
        element = self.elements.get(name)
        items = () if element is None else element.iterfind("Item")
        return {item.get("key", ""): item.get("value", "") for item in items}

    def placements(self, name: str) -> list[MatrixRows]:
        """Of a list of placements."""
        return [placement_rows(values) for values in records(self.content(name), "7d")]

    def vectors(self, name: str) -> list[Vector]:
        """Of a list of vectors."""
        return [(x, y, z) for x, y, z in records(self.content(name), "3d")]

    def _value(self, name: str, default: str) -> str:
        element = self.elements.get(name)
        return default if element is None else element.get("value", default)


def child_text(record: Element, name: str, default: str) -> str:
    """The value of a field of a record."""
    child = record.find(name)
    return default if child is None else child.get("value", default)


def child_number(record: Element, name: str, default: float) -> float:
    """The same of a number."""
    return _number(child_text(record, name, str(default)))


def child_points(record: Element, path: str) -> list[tuple[float, float]]:
    """The points of a record, in its plane. Raises DamagedError where there is none."""
    found = [(_number(each.get("X", "")), _number(each.get("Y", ""))) for each in record.iterfind(path)]
    if not found:
        raise DamagedError(f'a line has no "{path.partition("/")[0]}"')
    return found


def records(data: bytes | None, layout: str) -> list[tuple[float, ...]]:
    """Records of a list's file: their number (uint32), then the numbers of each, little-endian.

    Raises:
        DamagedError: the file does not hold as many, or numbers are not finite.
    """
    if not data:
        return []
    size = struct.calcsize(f"<{layout}")
    count = struct.unpack_from("<I", data)[0] if len(data) >= 4 else 0
    if len(data) < 4 + count * size:
        raise DamagedError("a list is cut short")
    found = list(struct.iter_unpack(f"<{layout}", data[4 : 4 + count * size]))
    if not all(math.isfinite(value) for record in found for value in record):
        raise DamagedError("a list holds what is no number")
    return found


def placement_rows(values: list[float] | tuple[float, ...]) -> MatrixRows:
    """The placement of a shift x, y, z and a turn, the quaternion x, y, z, w."""
    px, py, pz, x, y, z, w = values
    length = math.sqrt(x * x + y * y + z * z + w * w)
    if length == 0.0 or not math.isfinite(length):
        x, y, z, w, length = 0.0, 0.0, 0.0, 1.0, 1.0
    x, y, z, w = x / length, y / length, z / length, w / length
    rows = (
        *(1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), px),
        *(2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), py),
        *(2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), pz),
    )
    return IDENTITY if rows == IDENTITY else rows


def _number(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise DamagedError(f'"{text[:40]}" is no number') from None
    if not math.isfinite(value):
        raise DamagedError(f'"{text[:40]}" is no finite number')
    return value


def _target(element: Element) -> str:
    """The name of the object that an element of a link stands for."""
    match element.tag:
        case "Link" | "LinkSub":
            return element.get("value", "") or element.get("obj", "")
        case "XLink":
            return element.get("name", "")
    return ""
