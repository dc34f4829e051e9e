"""Reports of batches that nobody ran: documents as `manifest.json` has them, and drawings to go with them."""

import json
from pathlib import Path

from hlr.batch.page import write

SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60" fill="none"'
    ' stroke="#000000"><metadata><drawing xmlns="urn:hlr:drawing:1"><part index="0" name="{name}"/></drawing>'
    '</metadata><g id="visible" class="visible"><g class="sharp"><g data-part="0">'
    '<path d="M10 10h{size}" data-edge="4"/></g></g></g>{more}</svg>'
)


def drawing(file, view="front", warning=None, **more):
    """A drawing of a report."""
    notes = [{"code": "a", "text": warning, "warning": True}] if warning else []
    return {"files": {"svg": file}, "view": view, "notes": notes, "seconds": {"source": 0.1, "total": 0.25}, **more}


def source(name, *drawings, error=None, options=()):
    """A source of a report."""
    return {
        "source": name,
        "options": dict(options),
        "error": error and {"kind": "SourceError", "message": error},
        "drawings": list(drawings),
        "cost": {"seconds": 0.5, "peak_memory_mb": 1.0},
    }


def report(*sources, **more):
    """A report of these sources."""
    counts = {
        "sources": len(sources),
        "drawings": sum(len(each["drawings"]) for each in sources),
        "failed": sum(each["error"] is not None for each in sources),
        "warned": 0,
    }
    return {"hlr": "1.0", "counts": counts, "sources": list(sources), **more}


def written(found, folder, svg=SVG, name="bolt", size=80, more=""):
    """Write the page of a report, and the drawings that are not there. Returns the page."""
    for each in found["sources"]:
        for one in each["drawings"]:
            path = Path(folder, one["files"]["svg"])
            path.parent.mkdir(parents=True, exist_ok=True)
            if not path.exists():
                path.write_text(svg.format(name=name, size=size, more=more))
    return page_of(found, folder)


def page_of(found, folder):
    """Write the page of a report whose drawings are there."""
    write.write(found, json.dumps(found).encode(), Path(folder))
    return Path(folder, "index.html")
