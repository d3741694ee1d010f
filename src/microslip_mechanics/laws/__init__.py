"""Laws of elements, one to a file, and the catalogue of them."""
