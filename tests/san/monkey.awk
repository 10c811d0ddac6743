# A user who tries everything: events for FB_INPUT (src/host/host.cpp), the same for the same seed.
#
#   awk -v seed=N -f tests/san/monkey.awk
BEGIN {
	srand(seed)
	keys = split("* - + F1 F2 F3 F4 UP DOWN LEFT RIGHT PGUP PGDN INS DEL SPACE ENTER TAB a b c d e f g h i k l m n o p r s t " \
		"u v w x y z A C S L U [ ] < > , . = _ 1 2 3 4", key, " ")
	split("- L R LR", held, " ")
	for (frame = 0; frame < 25; ++frame) {
		events = int(rand() * 5)
		for (i = 0; i < events; ++i) {
			if (rand() < 0.5) {
				print frame, "key", key[1 + int(rand() * keys)]
			} else {
				far = rand() < 0.1 ? 30000 : 60
				print frame, "mouse", int((rand() * 2 - 1) * far), int((rand() * 2 - 1) * far), held[1 + int(rand() * 4)]
			}
		}
	}
}
