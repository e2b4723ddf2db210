"""Studies of films: bits a second and lost packets, beside exact counting."""
