# A user who tries everything: events for FB_INPUT (src/host/host.cpp), the same for the same seed.
#
#   awk -v seed=N -f tests/san/monkey.awk
BEGIN {
	srand(seed)
	keys = split("* - + F1 F2 F3 F4 UP DOWN LEFT RIGHT PGUP PGDN INS DEL HOME END SPACE ENTER ENTER ENTER BACKSPACE TAB TAB " \
		"a b c d e f g h i j k l l m n o o p q r r s t u u v w x y z A C E G H J L N Q S U V W X Y Z [ ] < > ; ' , . = _ " \
		"1 2 3 4 5 6 7 8 9 0",
		key, " ")
	split("- L R LR", held, " ")
	for (frame = 0; frame < 25; ++frame) {
		events = int(rand() * 5)
		late = 0
		for (i = 0; i < events; ++i) {
			# Some come while the frame is drawn.
			late += rand() < 0.2 ? int(rand() * 8) : 0
			when = frame (late > 0 ? "." late : "")
			if (rand() < 0.5) {
				print when, "key", key[1 + int(rand() * keys)]
			} else {
				far = rand() < 0.1 ? 30000 : 60
				print when, "mouse", int((rand() * 2 - 1) * far), int((rand() * 2 - 1) * far), held[1 + int(rand() * 4)]
			}
		}
	}
	if (rand() < 0.3)
		print 25 "." 1 + int(rand() * 9), "key", rand() < 0.7 ? "ESC" : "BREAK"
}
