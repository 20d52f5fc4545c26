"""Three packages of a lab that adds to Recollect, and the tests that install and use them."""
