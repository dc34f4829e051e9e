import json

LONG = "a name so long that no terminal could s…"


def test_table(hlr_command):
    result = hlr_command("info", "a.step")
    assert result.code == 0
    assert result.err == "hlr: warning: part 9 could not be read.\n"
    assert result.out == (
        "a.step: step, 25.4 x 50.8 x 88.9 mm, 1 unit = 25.4 mm\n"
        "\n"
        "part                                      solids  faces  edges  triangles   closed  defects\n"
        "housing                                        1    120    340       5600      yes\n"
        f"{LONG}       0      3      9         12       no  4 open edges; 1 duplicated face\n"
        "tw\\x1bisted                                    1      6     12         12  twisted\n"
        "3 parts                                        2    129    361       5624      1/3\n"
    )


def test_json(hlr_command):
    result = hlr_command("info", "a.step", "--json")
    assert result.code == 0
    model = json.loads(result.out)
    assert (model["source"], model["kind"], model["unit"]) == ("a.step", "step", 25.4)
    assert model["bounds"] == [[0, 0, 0], [1, 2, 3.5]]
    assert model["parts"][1] == {
        "name": "a name so long that no terminal could show all of it",
        "color": [1, 0.5, 0],
        "solids": 0,
        "faces": 3,
        "edges": 9,
        "triangles": 12,
        "closed": False,
        "oriented": True,
        "defects": ["4 open edges", "1 duplicated face"],
    }
    assert model["notes"] == [{"code": "not-meshed", "text": "part 9 could not be read"}]


def test_a_source_that_cannot_be_read(hlr_command):
    result = hlr_command("info", "missing.step", "--json")
    assert (result.code, result.err) == (2, "hlr: cannot read missing.step: there is no such file.\n")
    assert json.loads(result.out)["error"]["message"] == "cannot read missing.step: there is no such file."
