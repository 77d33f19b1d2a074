# The module holds nothing: it is imported, or refuses to be (python/machine/machine.cpp).
