"""The list of the examples that come with the program."""

from amp_studio.files.example_files import examples, examples_folder


def test_every_example_is_listed_with_its_family_and_what_it_is() -> None:
    found = examples()
    assert {e.path for e in found} == set(examples_folder().glob("*/*.amp"))
    assert [e.family for e in found] == sorted(e.family for e in found)
    lathe = next(e for e in found if e.path.stem == "LATHE_LS176")
    assert (lathe.family, lathe.title) == ("9pc", "Lathe with a distance-coded scale")
    assert lathe.description.startswith("X and Z on two axis modules")
